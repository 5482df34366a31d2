// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/fusion/moment_pyramid.h"

namespace dhpmap {

/// Planes through a scan's points where rings lie so far apart that a window of 16 voxels holds one of them: the points
/// in windows of 32 voxels a side and, where these are in a line too, of 64. A window is that of all voxels in its
/// inner half. Not thread-safe.
class WidePlanes {
 public:
  /// Forgets the last segment. What planes of this one need is summed up when the first is asked for.
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
