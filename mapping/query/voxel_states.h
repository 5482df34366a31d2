// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mapping/map/free_tile.h"
#include "mapping/query/query_scope.h"
#include "mapping/query/query_world.h"
#include "mapping/query/surface_cache.h"

namespace dhpmap {

enum class VoxelState : std::uint8_t { kUnknown, kFree, kOccupied };

/// What is known of the voxels of a map's own grid, asked of every submap that counts at the voxel's centre:
/// - occupied: a surface is within half a voxel, or the voxel is behind one, in its band, and nobody looked through it;
/// - free: else, if somebody looked through it or observed it in front of a surface;
/// - unknown: else.
/// Works block by block and keeps what it made last: belongs to one thread.
class VoxelStates {
 public:
  struct Voxel {
    VoxelState state = VoxelState::kUnknown;
    const SubmapInfo* submap = nullptr;  ///< of an occupied one, whose surface is nearest; only if objects are wanted
  };

  VoxelStates(std::shared_ptr<const MapSurfaces> surfaces, const QueryScope& scope, bool with_objects);

  /// Of the voxel that holds the point (finite, metres of the map frame).
  [[nodiscard]] Voxel At(const Eigen::Vector3d& p_map);

 private:
  struct Block {
    FreeMask occupied{}, free{};
    std::vector<std::uint32_t> numbers;  ///< of the submaps; empty: not wanted, or nothing is occupied
  };
  class Maker;

  const Block& BlockAt(BlockIndex index);

  const QueryWorld world_;
  const bool with_objects_;
  const double voxel_size_m_, reach_m_;
  std::unordered_map<BlockIndex, Block, BlockIndexHash> blocks_;
  BlockIndex last_index_;
  const Block* last_ = nullptr;
};

}  // namespace dhpmap
