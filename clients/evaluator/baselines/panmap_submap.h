// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mapping/submap/submap.h"

namespace dhpmap::evaluator {

/// Panmap's moving binary count: for each voxel of a block, how often observations there were of the submap's class,
/// and how often not. Bytes; when one is full, both are halved.
class BelongingBlock {
 public:
  void Add(std::size_t linear, bool belongs);
  void Add(std::size_t linear, const BelongingBlock& other);
  /// True if nothing was counted.
  [[nodiscard]] bool Belongs(std::size_t linear) const { return belongs_[linear] >= foreign_[linear]; }
  [[nodiscard]] int NumBelonging(std::size_t linear) const { return belongs_[linear]; }
  [[nodiscard]] int NumForeign(std::size_t linear) const { return foreign_[linear]; }

 private:
  void Set(std::size_t linear, int belongs, int foreign);
  std::array<std::uint8_t, kBlockVoxels> belongs_{}, foreign_{};
};

/// A submap of Panmap: the geometry of everything in its blocks, and which voxels belong to it, on the map's grid.
/// `geometry.info()` has its class, life cycle and counters. Thread-compatible.
struct PanmapSubmap {
  PanmapSubmap(SubmapInfo info, int num_reobservations)
      : geometry(std::move(info), 1), num_reobservations_left(num_reobservations) {}

  [[nodiscard]] bool IsActive() const { return geometry.info().activity == Activity::kActive; }
  [[nodiscard]] bool Belongs(VoxelIndex voxel) const;
  /// The geometry of only the voxels that belong to it, for meshing.
  [[nodiscard]] Submap OwnGeometry() const;
  /// Share of the counts that say "belongs".
  [[nodiscard]] float Confidence() const;

  Submap geometry;
  std::unordered_map<BlockIndex, BelongingBlock, BlockIndexHash> belonging;
  int num_reobservations_left;  ///< it must be tracked in this many further frames, else it is deleted
  bool was_tracked = true;      ///< in the current frame, or created in it
};

/// Sorted by id.
using PanmapSubmaps = std::vector<std::unique_ptr<PanmapSubmap>>;

}  // namespace dhpmap::evaluator
