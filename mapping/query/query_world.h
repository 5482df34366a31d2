// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "mapping/query/query_scope.h"
#include "mapping/surfaces/nearest_search.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// A state of a map as a query sees it: which submaps it contains, how far their surfaces are grown, and which space is
/// known. Submaps are identified by their number in MapSurfaces. Immutable, thread-safe.
class QueryWorld {
 public:
  /// Submaps with the same padding.
  struct Grown {
    double padding_m;
    std::vector<bool> is_held;  ///< by number; empty: all
  };
  /// Observations of a place.
  struct Sight {
    bool is_seen = false;   ///< a sensor has observed the place
    bool is_front = false;  ///< and it is in front of a surface, or free
  };

  QueryWorld(std::shared_ptr<const MapSurfaces> surfaces, const QueryScope& scope);

  [[nodiscard]] const MapSurfaces& surfaces() const { return *surfaces_; }
  [[nodiscard]] const std::shared_ptr<const MapSurfaces>& shared_surfaces() const { return surfaces_; }
  [[nodiscard]] double voxel_size_m() const { return surfaces_->state().info().config.voxel_size_m; }
  [[nodiscard]] bool Holds(std::size_t number) const { return is_held_.empty() || is_held_[number]; }
  /// Whether a submap is an obstacle: it is in the world, and the query may not touch it.
  [[nodiscard]] bool IsInTheWay(std::size_t number) const {
    return in_the_way_.empty() ? Holds(number) : in_the_way_[number];
  }
  /// Whether the query takes the whole map without exclusions, age limit and padding.
  [[nodiscard]] bool TakesAllAsItIs() const { return takes_all_ && grown_.size() == 1 && most_padding_m() == 0; }
  /// By number, whether a submap is in the world; empty: all are.
  [[nodiscard]] const std::vector<bool>& is_held() const { return is_held_; }
  /// Whether all submaps that a triangle needs are in the world.
  [[nodiscard]] bool HoldsAll(std::span<const SubmapId> needed) const { return surfaces_->Holds(needed, is_held_); }
  /// Groups of obstacles by padding, the largest padding first; at least one. Each obstacle is in exactly one group.
  [[nodiscard]] std::span<const Grown> grown() const { return grown_; }
  [[nodiscard]] double most_padding_m() const { return grown_.front().padding_m; }
  /// Of a submap that is an obstacle.
  [[nodiscard]] double padding_m(std::size_t number) const {
    for (const Grown& grown : grown_) {
      if (grown.is_held.empty() || grown.is_held[number]) return grown.padding_m;
    }
    return 0;
  }

  /// Whether a voxel of the map's grid is free: sensors have looked through it recently enough, or it is vacated and
  /// the scope treats vacated space as free.
  [[nodiscard]] bool IsFree(VoxelIndex voxel) const {
    const FreeTile* tile = FindFreeTile(TileOf(BlockOf(voxel)));
    return tile != nullptr && tile->IsFree(CellOf(BlockOf(voxel)), LinearIndex(voxel));
  }
  /// The free voxels of a tile, if seen recently enough; null: none.
  [[nodiscard]] const FreeTile* FindFreeTile(TileIndex index) const {
    if (const FreeTile* tile = with_vacated_.Find(index); tile != nullptr) return tile;
    return FindLookedThrough(index);
  }
  /// Whether a submap of the world has an observed voxel at this voxel's centre, or the place was left (IsLeft).
  [[nodiscard]] bool IsObserved(VoxelIndex voxel) const;
  /// Whether an unseen voxel is inside an object that may be touched; it is then no obstacle, like the object's
  /// surface. The nearest of all surfaces in the world to its centre must be one that may be touched, and the centre
  /// must be behind it, not beside its border. This is where DistanceQuery without padding is negative and names that
  /// object. No deeper than `max_depth_m`.
  [[nodiscard]] bool IsInTouchable(VoxelIndex voxel, double max_depth_m) const;
  /// Whether anything may be touched.
  [[nodiscard]] bool has_touchable() const { return !in_the_way_.empty(); }
  /// Whether it is free or observed.
  [[nodiscard]] bool IsSeen(VoxelIndex voxel) const { return IsFree(voxel) || IsObserved(voxel); }
  /// Whether a place is free because an object has left it: an attached one, or an excluded one if the scope treats its
  /// place as free. The place of an object consists of its observed voxels; for things and attached objects also of the
  /// space behind their surface in the box around them.
  [[nodiscard]] bool IsLeft(const Eigen::Vector3d& p_map) const;
  /// The same for all voxels of a block.
  [[nodiscard]] FreeMask LeftVoxels(BlockIndex block) const;
  /// Whether a place is within the range of voxel indices.
  [[nodiscard]] bool IsInReach(const Eigen::Vector3d& p_map) const {
    constexpr double kIndexReach_vox = 1 << 30;
    return p_map.cwiseAbs().maxCoeff() < kIndexReach_vox * voxel_size_m();
  }
  /// IsFree for all voxels of a block.
  [[nodiscard]] FreeMask FreeVoxels(BlockIndex block) const {
    const FreeTile* tile = FindFreeTile(TileOf(block));
    return tile != nullptr ? tile->MaskOf(CellOf(block)) : FreeMask{};
  }
  /// The voxels that sensors have looked through recently enough.
  [[nodiscard]] FreeMask LookedThrough(BlockIndex block) const {
    const FreeTile* tile = FindLookedThrough(TileOf(block));
    return tile != nullptr ? tile->MaskOf(CellOf(block)) : FreeMask{};
  }
  /// Whether a place within the range of the grid is free, or observed by a submap of the world. `nearest`: the nearest
  /// surface.
  [[nodiscard]] bool IsSeenAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const;
  /// Observations of a place within the range of the grid. `nearest`: the nearest surface; its submap is tested first,
  /// because it usually has observed the place. An object that may be touched can show that a place is in front, but
  /// not that it is inside.
  [[nodiscard]] Sight SightAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const;
  /// Whether an unseen place is inside a thing that is an obstacle: see thing_inside.h. Searches the nearest surface of
  /// each thing around. `is_across`: the place is known to be straight in front of the nearest surface.
  [[nodiscard]] bool IsInsideThing(const Eigen::Vector3d& p_map, bool is_across) const;

 private:
  /// Observations of a place in a cell, if the world has all submaps and no age limit.
  [[nodiscard]] Sight SightIn(const CellSight& cell, const Eigen::Vector3d& p_map) const;
  [[nodiscard]] bool HasLeft(std::size_t number, const Eigen::Vector3d& p_map) const;
  /// IsInsideThing for a single thing.
  [[nodiscard]] bool IsInside(std::uint32_t number, const Eigen::Vector3d& p_map, bool is_across) const;
  /// Straight in front of the nearest surface within a limit.
  [[nodiscard]] bool IsStraightInFront(const Eigen::Vector3d& p_map, double limit_m) const;

  [[nodiscard]] const FreeTile* FindLookedThrough(TileIndex index) const {
    const FreeTile* tile = free_space_->Find(index);
    return tile != nullptr && tile->last_seen_ns() >= oldest_ns_ ? tile : nullptr;
  }
  /// The tiles with vacated voxels, together with their free voxels.
  [[nodiscard]] FreeSpace WithVacated() const;

  std::shared_ptr<const MapSurfaces> surfaces_;
  const FreeSpace* free_space_;
  FreeSpace with_vacated_;  ///< tiles that replace those of free_space_; by the scope
  std::int64_t oldest_ns_ = std::numeric_limits<std::int64_t>::min();  ///< earlier views do not count
  std::vector<bool> is_held_;                                          ///< by the scope; empty: all are
  std::vector<bool> in_the_way_;                                       ///< by the scope; empty: all in the world
  bool takes_all_ = false;                                             ///< submaps and views
  std::vector<Grown> grown_;
  std::vector<bool> has_left_;     ///< by number, whether its place is free; empty: none
  std::vector<bool> is_attached_;  ///< by number; empty: none
};

}  // namespace dhpmap
