// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/base/spread.h"
#include "mapping/map/map.h"
#include "mapping/voxels/block_tile.h"

namespace dhpmap {

/// An observed voxel of a submap.
struct ObservedVoxel {
  Eigen::Vector3d centre_m;  ///< map frame
  float distance_m = 0;
  float weight = 0;
  Color color;
  std::int32_t class_id = -1;  ///< most frequent class, or that of the submap; -1: none
  float class_confidence = 0;
};

/// Iterates over the observed voxels of one submap, block by block. Keeps only a few of the tiles in memory that it
/// reads from disk. Thread-compatible; pins its snapshot.
class VoxelWalk {
 public:
  /// Only voxels with |distance| up to `max_abs_distance_m`; 0: all. NOT_FOUND; INVALID_ARGUMENT for a negative or
  /// non-finite distance. `spread` reads from disk and outlives the walk. Throws StatusError.
  static Result<VoxelWalk> Begin(std::shared_ptr<const MapSnapshot> snapshot, SubmapId submap,
                                 double max_abs_distance_m, Spread spread = InPlace);

  [[nodiscard]] std::int64_t revision() const { return snapshot_->revision(); }
  /// Whether every block has been visited.
  [[nodiscard]] bool is_done() const { return tile_ == submap_->blocks().tiles().size(); }
  /// The voxels of the next block, kBlockVoxels at most; valid until the next call. Requires !is_done(). Throws
  /// StatusError.
  std::span<const ObservedVoxel> NextBlock();

 private:
  VoxelWalk(std::shared_ptr<const MapSnapshot> snapshot, const Submap& submap, double max_abs_distance_m,
            Spread spread);
  BlockEntry Next();
  /// The next tile and some after it.
  void ReadAhead();

  std::shared_ptr<const MapSnapshot> snapshot_;
  const Submap* submap_;
  double max_abs_distance_m_;
  Spread spread_;
  std::size_t tile_ = 0, block_ = 0;                        ///< the next
  std::deque<std::shared_ptr<const ScannedTile>> scanned_;  ///< that tile, once started, and prefetched ones
  std::vector<ObservedVoxel> voxels_;
};

}  // namespace dhpmap
