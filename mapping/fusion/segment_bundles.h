// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/grid.h"
#include "mapping/voxels/voxel_mask.h"

namespace dhpmap {

/// The surface where a bundle ends: what lies at p, relative to the sensor's origin and along the axes of the grid, is
/// normal * p + offset_m before it (negative: behind).
struct TangentPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the sensor
  float offset_m = 0;                                ///< of the sensor
  float before_m = 0, behind_m = 0;                  ///< how far along the ray, about the end, it was seen
};

/// The points of one segment that end in the same voxel, to be traced as one ray (paper II-C). Positions are relative
/// to the sensor's origin, along the axes of the grid.
struct Bundle {
  Eigen::Vector3f weighted_sum_m = Eigen::Vector3f::Zero();
  float weight = 0;
  Eigen::Vector3f weighted_color = Eigen::Vector3f::Zero();
  std::uint32_t num_points = 0;
  TangentPlane plane;        ///< see FitTangentPlanes
  std::uint16_t linear = 0;  ///< its end voxel, in the cell's block
};

/// The bundles of one segment that end in one block, by the voxels in which they end.
struct BundleCell {
  BlockIndex block;
  std::uint32_t first_bundle = 0;
  std::uint32_t num_bundles = 0;
  VoxelMask ends{};                               ///< the voxels in which a bundle ends
  std::array<std::uint16_t, kBlockSide> up_to{};  ///< bundles before those of a word of `ends`; see CountBundles

  /// Of the bundle that ends in a voxel, among all of the segment.
  [[nodiscard]] std::uint32_t BundleAt(int linear) const {
    const auto word = static_cast<std::size_t>(linear >> 6);
    const std::uint64_t before = ends[word] & ((std::uint64_t{1} << (linear & 63)) - 1);
    return first_bundle + up_to[word] + static_cast<std::uint32_t>(std::popcount(before));
  }
  /// Sets num_bundles and up_to by the ends.
  void CountBundles();
  /// One more, which ends in a voxel in which none did.
  void AddBundle(int linear);
};

/// One segment of a frame, bundled on a grid.
class alignas(kCacheLineBytes) SegmentBundles {
 public:
  /// Row of the frame's segment table, or -1 for points of no known object.
  int row = -1;
  /// Of a frame that has more than kMaxBlocksAFrame cells, which must be refused: nothing else of it is here.
  bool is_cut_short = false;
  std::int64_t num_points = 0;
  std::vector<BundleCell> cells;
  std::vector<Bundle> bundles;  ///< cell by cell

  /// Null if no bundle ends in that block.
  [[nodiscard]] const BundleCell* Find(BlockIndex block) const;
  [[nodiscard]] bool EndsIn(VoxelIndex voxel) const;

  /// May invalidate references to cells.
  BundleCell& FindOrInsert(BlockIndex block);
  /// Adds a bundle that ends in a block, as another segment has it: those of a cell together, by their voxels. Returns
  /// whether the cell is new.
  bool Append(BlockIndex block, const Bundle& bundle);

  /// Nothing is in it then; it keeps its memory.
  void Reset();
  /// All that it keeps.
  [[nodiscard]] std::size_t BufferBytes() const;

 private:
  std::vector<std::uint32_t> slots_;  // open addressing over cells, 1 + index, 0 = free
};

/// What is left of a frame that has too many cells: a segment of unknown objects and one a table row, all cut short.
std::vector<SegmentBundles> CutShortSegments(std::size_t num_rows);

}  // namespace dhpmap
