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
  [[nodiscard]] const std::shared_ptr<const MapSurfaces>& shared_surfaces() const { return surfaces_; }
  [[nodiscard]] double voxel_size_m() const { return surfaces_->state().info().config.voxel_size_m; }
  [[nodiscard]] bool Holds(std::size_t number) const { return is_held_.empty() || is_held_[number]; }
  /// Whether what a submap has is in the way: it is there, and whoever asks may not touch it.
  [[nodiscard]] bool IsInTheWay(std::size_t number) const {
    return in_the_way_.empty() ? Holds(number) : in_the_way_[number];
  }
  /// Whether all submaps and looks count, and nothing is grown.
  [[nodiscard]] bool TakesAllAsItIs() const { return takes_all_ && grown_.size() == 1 && most_padding_m() == 0; }
  /// By number, which submaps are there; empty: all.
  [[nodiscard]] const std::vector<bool>& is_held() const { return is_held_; }
  /// Whether all that a triangle needs is there.
  [[nodiscard]] bool HoldsAll(std::span<const SubmapId> needed) const { return surfaces_->Holds(needed, is_held_); }
  /// Every submap that is in the way is in exactly one of these; at least one, those that are grown most first.
  [[nodiscard]] std::span<const Grown> grown() const { return grown_; }
  [[nodiscard]] double most_padding_m() const { return grown_.front().padding_m; }
  /// Of a submap that is in the way.
  [[nodiscard]] double padding_m(std::size_t number) const {
    for (const Grown& grown : grown_) {
      if (grown.is_held.empty() || grown.is_held[number]) return grown.padding_m;
    }
    return 0;
  }

  /// Whether sensors have looked through a voxel of the map's grid, and lately enough; or something has left it, if
  /// that is free.
  [[nodiscard]] bool IsFree(VoxelIndex voxel) const {
    const FreeTile* tile = FindFreeTile(TileOf(BlockOf(voxel)));
    return tile != nullptr && tile->IsFree(CellOf(BlockOf(voxel)), LinearIndex(voxel));
  }
  /// What of a tile is free, if that is late enough; null: nothing.
  [[nodiscard]] const FreeTile* FindFreeTile(TileIndex index) const {
    if (const FreeTile* tile = with_vacated_.Find(index); tile != nullptr) return tile;
    return FindLookedThrough(index);
  }
  /// Whether a submap that is there has observed what is at the voxel's centre, or something has left it: IsLeft.
  [[nodiscard]] bool IsObserved(VoxelIndex voxel) const;
  /// Whether a voxel that nobody has seen is the inside of something that may be touched, which is then no more in the
  /// way than its surface: of all surfaces that are there the nearest to its centre is one that may be touched, which
  /// it is behind, and not beside where that ends. So where DistanceQuery, without padding, is negative and names it.
  /// No deeper than `max_depth_m`.
  [[nodiscard]] bool IsInTouchable(VoxelIndex voxel, double max_depth_m) const;
  /// Whether anything may be touched.
  [[nodiscard]] bool has_touchable() const { return !in_the_way_.empty(); }
  /// Whether it is free or observed.
  [[nodiscard]] bool IsSeen(VoxelIndex voxel) const { return IsFree(voxel) || IsObserved(voxel); }
  /// Whether a place is free because of what has left it: something that is attached, or left out of the world if that
  /// leaves what it hid free. That is where it observed something, and of a thing, or what is attached, in the box
  /// around it what lies behind its surface.
  [[nodiscard]] bool IsLeft(const Eigen::Vector3d& p_map) const;
  /// The same of all voxels of a block.
  [[nodiscard]] FreeMask LeftVoxels(BlockIndex block) const;
  /// Whether there is a voxel for a place.
  [[nodiscard]] bool IsInReach(const Eigen::Vector3d& p_map) const {
    constexpr double kIndexReach_vox = 1 << 30;
    return p_map.cwiseAbs().maxCoeff() < kIndexReach_vox * voxel_size_m();
  }
  /// The same of all voxels of a block.
  [[nodiscard]] FreeMask FreeVoxels(BlockIndex block) const {
    const FreeTile* tile = FindFreeTile(TileOf(block));
    return tile != nullptr ? tile->MaskOf(CellOf(block)) : FreeMask{};
  }
  /// Those that sensors have looked through, lately enough.
  [[nodiscard]] FreeMask LookedThrough(BlockIndex block) const {
    const FreeTile* tile = FindLookedThrough(TileOf(block));
    return tile != nullptr ? tile->MaskOf(CellOf(block)) : FreeMask{};
  }
  /// Whether a place within the reach of the grid is free, or a submap that is there has observed it. `nearest`: of the
  /// surfaces.
  [[nodiscard]] bool IsSeenAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const;
  /// Of a place within the reach of the grid. `nearest`: of the surfaces; asked first, as its submap mostly knows. What
  /// may be touched says where a place is in front, not where it is inside.
  [[nodiscard]] Sight SightAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const;
  /// Whether a place that nobody has seen is inside of a thing that is in the way: see thing_inside.h. Looks for
  /// the nearest surface of the things around. `is_across`: it is known to be straight in
  /// front of what is nearest to it.
  [[nodiscard]] bool IsInsideThing(const Eigen::Vector3d& p_map, bool is_across) const;

 private:
  /// What is known of a place in a cell, if all submaps are there and all that was looked through counts.
  [[nodiscard]] Sight SightIn(const CellSight& cell, const Eigen::Vector3d& p_map) const;
  [[nodiscard]] bool HasLeft(std::size_t number, const Eigen::Vector3d& p_map) const;
  /// Of one thing: see IsInsideThing.
  [[nodiscard]] bool IsInside(std::uint32_t number, const Eigen::Vector3d& p_map, bool is_across) const;
  /// Of whatever surface is nearest, within a limit.
  [[nodiscard]] bool IsStraightInFront(const Eigen::Vector3d& p_map, double limit_m) const;

  [[nodiscard]] const FreeTile* FindLookedThrough(TileIndex index) const {
    const FreeTile* tile = free_space_->Find(index);
    return tile != nullptr && tile->last_seen_ns() >= oldest_ns_ ? tile : nullptr;
  }
  /// The tiles of which something was left, with what was looked through.
  [[nodiscard]] FreeSpace WithVacated() const;

  std::shared_ptr<const MapSurfaces> surfaces_;
  const FreeSpace* free_space_;
  FreeSpace with_vacated_;  ///< instead of those of free_space_; by the scope
  std::int64_t oldest_ns_ = std::numeric_limits<std::int64_t>::min();  ///< of looks that count
  std::vector<bool> is_held_;                                          ///< by the scope; empty: all are
  std::vector<bool> in_the_way_;                                       ///< by the scope; empty: all that are there
  bool takes_all_ = false;                                             ///< submaps and looks
  std::vector<Grown> grown_;
  std::vector<bool> has_left_;     ///< by number, what leaves its place free; empty: nothing does
  std::vector<bool> is_attached_;  ///< the same, of what is attached
};

}  // namespace dhpmap
