// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/fusion/moment_pyramid.h"

namespace dhpmap {

/// Planes through a scan's points where rings lie so far apart that a window of 16 voxels contains only one. Uses
/// windows of 32 voxels a side and, if their points are still on a line, of 64. All voxels in the inner half of a
/// window share it. Not thread-safe.
class WidePlanes {
 public:
  /// Starts a new segment. Its sums are computed at the first request for a plane.
  void Reset();

  /// The plane around a voxel of the segment, whose pyramid has been built.
  const PlaneFit& At(VoxelIndex voxel, const SegmentBundles& segment, MomentPyramid& pyramid, float voxel_size_m);

  [[nodiscard]] std::size_t BufferBytes() const;

 private:
  /// Cubes of half a window's side, and the planes of windows, by the cube at their upper corner.
  struct Level {
    IndexMap<BlockIndex> cube_of, fit_of;
    std::vector<PlaneMoments> cubes;
    std::vector<PlaneFit> fits;
  };
  static constexpr std::size_t kNumLevels = 2;

  void SumUp(const SegmentBundles& segment, MomentPyramid& pyramid);
  static PlaneFit Fit(const Level& level, BlockIndex corner, float voxel_size_m);

  std::array<Level, kNumLevels> levels_;
  bool is_summed_ = false;
};

}  // namespace dhpmap
