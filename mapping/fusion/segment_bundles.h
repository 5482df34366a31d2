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

/// The surface at the end of a bundle. The signed distance of a point p, relative to the sensor's origin and along the
/// axes of the grid, is normal * p + offset_m; positive in front.
struct TangentPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the sensor
  float offset_m = 0;                                ///< signed distance of the sensor
  float before_m = 0, behind_m = 0;                  ///< observed extent along the ray, before and behind the end
};

/// The points of one segment that end in the same voxel, traced as one ray (paper II-C). Positions are relative to the
/// sensor's origin, along the axes of the grid.
struct Bundle {
  Eigen::Vector3f weighted_sum_m = Eigen::Vector3f::Zero();
  float weight = 0;
  Eigen::Vector3f weighted_color = Eigen::Vector3f::Zero();
  std::uint32_t num_points = 0;
  TangentPlane plane;        ///< see FitTangentPlanes
  std::uint16_t linear = 0;  ///< end voxel, in the cell's block
};

/// The bundles of one segment that end in one block, by their end voxels.
struct BundleCell {
  BlockIndex block;
  std::uint32_t first_bundle = 0;
  std::uint32_t num_bundles = 0;
  VoxelMask ends{};                               ///< end voxels of the bundles
  std::array<std::uint16_t, kBlockSide> up_to{};  ///< number of bundles before each word of `ends`; see CountBundles

  /// Index, in the segment, of the bundle that ends in a voxel.
  [[nodiscard]] std::uint32_t BundleAt(int linear) const {
    const auto word = static_cast<std::size_t>(linear >> 6);
    const std::uint64_t before = ends[word] & ((std::uint64_t{1} << (linear & 63)) - 1);
    return first_bundle + up_to[word] + static_cast<std::uint32_t>(std::popcount(before));
  }
  /// Derives num_bundles and up_to from `ends`.
  void CountBundles();
  /// Adds a bundle in a voxel without one.
  void AddBundle(int linear);
};

/// One segment of a frame, bundled on a grid.
class alignas(kCacheLineBytes) SegmentBundles {
 public:
  /// Row of the frame's segment table, or -1 for points of no known object.
  int row = -1;
  /// The frame exceeds kMaxBlocksAFrame cells and must be refused: this holds no data.
  bool is_cut_short = false;
  std::int64_t num_points = 0;
  std::vector<BundleCell> cells;
  std::vector<Bundle> bundles;  ///< cell by cell

  /// Null if no bundle ends in that block.
  [[nodiscard]] const BundleCell* Find(BlockIndex block) const;
  [[nodiscard]] bool EndsIn(VoxelIndex voxel) const;

  /// May invalidate references to cells.
  BundleCell& FindOrInsert(BlockIndex block);
  /// Appends a bundle from another segment; the bundles of a cell must be contiguous, by voxel. Returns whether the
  /// cell is new.
  bool Append(BlockIndex block, const Bundle& bundle);

  /// Clears it but keeps its memory.
  void Reset();
  /// Memory of its buffers.
  [[nodiscard]] std::size_t BufferBytes() const;

 private:
  std::vector<std::uint32_t> slots_;  // open addressing over cells, 1 + index, 0 = free
};

/// Placeholder for a frame with too many cells: one segment for unknown objects and one a table row, all cut short.
std::vector<SegmentBundles> CutShortSegments(std::size_t num_rows);

}  // namespace dhpmap
