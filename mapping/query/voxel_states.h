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
  kUnknown,  ///< nobody has seen it
  kFree,     ///< somebody has looked through it, or observed it in front of a surface
  kInside,   ///< observed behind a surface, in its band, and nobody has looked through it
};

/// What is known of the voxels of a map's own grid, asked of every submap that counts at the voxel's centre; of whether
/// there is a surface in them they say nothing.
/// Works block by block and keeps what it made last: belongs to one thread.
class VoxelStates {
 public:
  struct Voxel {
    VoxelState state = VoxelState::kUnknown;
    const SubmapInfo* submap = nullptr;  ///< of one inside, whose surface is nearest; only if objects are wanted
  };

  VoxelStates(const std::shared_ptr<const MapSurfaces>& surfaces, const DistanceOptions& options, bool with_objects);

  /// Of the voxel that holds the point (finite, metres of the map frame).
  [[nodiscard]] Voxel At(const Eigen::Vector3d& p_map);
  /// Of one that is unknown, whether its centre is inside all the same: where distances (DistanceQuery) are negative.
  [[nodiscard]] Voxel UnseenAt(const Eigen::Vector3d& p_map);

 private:
  struct Block {
    FreeMask inside{}, free{};
    FreeMask behind{};  ///< of what is unknown; once somebody has asked
    bool is_behind_known = false;
    std::vector<std::uint32_t> numbers;          ///< of the submaps; empty: not wanted, or nothing is inside
    std::vector<const SubmapInfo*> behind_whom;  ///< likewise of what is unknown
    [[nodiscard]] FreeMask Unknown() const;
  };
  class Maker;

  Block& BlockAt(BlockIndex index);
  void LookBehind(Block& block);
  /// What was kept of it; null: nothing, or not of all that is unknown now.
  [[nodiscard]] const UnseenInside* FindKept(const FreeMask& unknown) const;
  [[nodiscard]] std::unique_ptr<const UnseenInside> AskBehind(const FreeMask& unknown) const;
  /// Null: out of reach.
  Block* BlockOfPoint(const Eigen::Vector3d& p_map, int& linear);

  const QueryWorld world_;
  const DistanceQuery distances_;
  const bool with_objects_;
  const double max_distance_m_;
  const bool keeps_;  ///< what is asked of the unknown, with what is near to it
  const double voxel_size_m_, reach_m_;
  std::unordered_map<BlockIndex, Block, BlockIndexHash> blocks_;
  BlockIndex last_index_;
  Block* last_ = nullptr;
};

}  // namespace dhpmap
