// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mapping/free/free_tile.h"
#include "mapping/query/distance_query.h"
#include "mapping/query/query_world.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

enum class VoxelState : std::uint8_t {
  kUnknown,  ///< unseen
  kFree,     ///< a sensor has looked through it, or observed it in front of a surface
  kInside,   ///< observed behind a surface, inside the truncation band, and no sensor has looked through it
};

/// States of the voxels of a map's own grid, from every submap of the world at the voxel's centre. A state does not say
/// whether the voxel contains a surface. Works block by block and caches blocks: one owner, not thread-safe.
class VoxelStates {
 public:
  struct Voxel {
    VoxelState state = VoxelState::kUnknown;
    const SubmapInfo* submap = nullptr;  ///< of kInside, the owner of the nearest surface; only with `with_objects`
  };

  VoxelStates(const std::shared_ptr<const MapSurfaces>& surfaces, const DistanceOptions& options, bool with_objects);

  /// The voxel that contains the point (finite, metres of the map frame).
  [[nodiscard]] Voxel At(const Eigen::Vector3d& p_map);
  /// For an unknown voxel: kInside if its centre has a negative distance (DistanceQuery).
  [[nodiscard]] Voxel UnseenAt(const Eigen::Vector3d& p_map);

 private:
  struct Block {
    FreeMask inside{}, free{};
    FreeMask behind{};  ///< unknown voxels that are inside; valid if is_behind_known
    bool is_behind_known = false;
    std::vector<std::uint32_t> numbers;          ///< of the submaps; empty: not requested, or no voxel is inside
    std::vector<const SubmapInfo*> behind_whom;  ///< likewise for unknown voxels
    [[nodiscard]] FreeMask Unknown() const;
  };
  class Maker;

  Block& BlockAt(BlockIndex index);
  void LookBehind(Block& block);
  /// The cached result; null: there is none for all voxels that are unknown now.
  [[nodiscard]] const UnseenInside* FindKept(const FreeMask& unknown) const;
  [[nodiscard]] std::unique_ptr<const UnseenInside> AskBehind(const FreeMask& unknown) const;
  /// Null: out of the range of the grid.
  Block* BlockOfPoint(const Eigen::Vector3d& p_map, int& linear);

  const QueryWorld world_;
  const DistanceQuery distances_;
  const bool with_objects_;
  const double max_distance_m_;
  const bool keeps_;  ///< stores results for unknown voxels with the lists of nearby tiles
  const double voxel_size_m_, reach_m_;
  std::unordered_map<BlockIndex, Block, BlockIndexHash> blocks_;
  BlockIndex last_index_;
  Block* last_ = nullptr;
};

}  // namespace dhpmap
