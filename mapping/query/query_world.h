// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "mapping/query/nearest_search.h"
#include "mapping/query/query_scope.h"
#include "mapping/query/surface_cache.h"

namespace dhpmap {

/// A state of a map as a query takes it: which submaps are there, how far their surfaces are grown, and what of space
/// is known. Submaps go by their number in MapSurfaces. Immutable, thread-safe.
class QueryWorld {
 public:
  /// Submaps that are grown by the same.
  struct Grown {
    double padding_m;
    std::vector<bool> is_held;  ///< by number; empty: all
  };
  /// What observations say of a place.
  struct Sight {
    bool is_seen = false;   ///< somebody has observed what is there
    bool is_front = false;  ///< and it was in front of a surface, or free
  };

  QueryWorld(std::shared_ptr<const MapSurfaces> surfaces, const QueryScope& scope);

  [[nodiscard]] const MapSurfaces& surfaces() const { return *surfaces_; }
  [[nodiscard]] double voxel_size_m() const { return surfaces_->state().info().config.voxel_size_m; }
  [[nodiscard]] bool Holds(std::size_t number) const { return is_held_.empty() || is_held_[number]; }
  /// Every submap that is there is in exactly one of these; at least one, those that are grown most first.
  [[nodiscard]] std::span<const Grown> grown() const { return grown_; }

  /// Whether sensors have looked through a voxel of the map's grid, and lately enough.
  [[nodiscard]] bool IsFree(VoxelIndex voxel) const {
    const FreeTile* tile = free_space_->Find(TileOf(BlockOf(voxel)));
    return tile != nullptr && tile->last_seen_ns() >= oldest_ns_ &&
           tile->IsFree(CellOf(BlockOf(voxel)), LinearIndex(voxel));
  }
  /// The same of all voxels of a block.
  [[nodiscard]] FreeMask FreeVoxels(BlockIndex block) const {
    const FreeTile* tile = free_space_->Find(TileOf(block));
    return tile != nullptr && tile->last_seen_ns() >= oldest_ns_ ? tile->MaskOf(CellOf(block)) : FreeMask{};
  }
  /// Whether it is free, or a submap that is there has observed what is at its centre.
  [[nodiscard]] bool IsSeen(VoxelIndex voxel) const;
  /// Whether a place within the reach of the grid is free, or a submap that is there has observed it. `nearest`: of the
  /// surfaces.
  [[nodiscard]] bool IsSeenAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const;
  /// Of a place within the reach of the grid. `nearest`: of the surfaces; asked first, as its submap mostly knows.
  [[nodiscard]] Sight SightAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const;

 private:
  std::shared_ptr<const MapSurfaces> surfaces_;
  const FreeSpace* free_space_;
  std::int64_t oldest_ns_ = std::numeric_limits<std::int64_t>::min();  ///< of looks that count
  std::vector<bool> is_held_;                                          ///< by the scope; empty: all are
  std::vector<Grown> grown_;
};

}  // namespace dhpmap
