// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mapping/submap/submap.h"

namespace dhpmap::evaluator {

/// For each voxel of a block, how often what was seen there was of the submap's class, and how often not: Panmap's
/// moving binary count. Bytes; when one is full, both are halved.
class BelongingBlock {
 public:
  void Add(std::size_t linear, bool belongs);
  void Add(std::size_t linear, const BelongingBlock& other);
  /// True where nothing was counted.
  [[nodiscard]] bool Belongs(std::size_t linear) const { return belongs_[linear] >= foreign_[linear]; }
  [[nodiscard]] int NumBelonging(std::size_t linear) const { return belongs_[linear]; }
  [[nodiscard]] int NumForeign(std::size_t linear) const { return foreign_[linear]; }

 private:
  void Set(std::size_t linear, int belongs, int foreign);
  std::array<std::uint8_t, kBlockVoxels> belongs_{}, foreign_{};
};

/// A submap of Panmap: geometry of everything in its blocks, and which voxels of it are its own. On the map's grid.
/// `geometry.info()` has its class, life cycle and counters. Thread-compatible.
struct PanmapSubmap {
  PanmapSubmap(SubmapInfo info, int num_reobservations)
      : geometry(std::move(info), 1), num_reobservations_left(num_reobservations) {}

  [[nodiscard]] bool IsActive() const { return geometry.info().activity == Activity::kActive; }
  [[nodiscard]] bool Belongs(VoxelIndex voxel) const;
  /// The geometry with only the voxels that belong to it, for a mesh of these.
  [[nodiscard]] Submap OwnGeometry() const;
  /// Share of the counts that say "belongs".
  [[nodiscard]] float Confidence() const;

  Submap geometry;
  std::unordered_map<BlockIndex, BelongingBlock, BlockIndexHash> belonging;
  int num_reobservations_left;  ///< in as many next frames it must be tracked, or it is deleted
  bool was_tracked = true;      ///< in the present frame, or made in it
};

/// By ascending id.
using PanmapSubmaps = std::vector<std::unique_ptr<PanmapSubmap>>;

}  // namespace dhpmap::evaluator
