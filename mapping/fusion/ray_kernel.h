// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/base/grid.h"

namespace dhpmap {

/// Number of rays traced side by side, one per lane.
inline constexpr std::size_t kRayLanes = 16;
using LaneFloats = std::array<float, kRayLanes>;

/// Bundles (see Bundle), one per lane, with the ends of their rays.
struct RayLanes {
  LaneFloats sum_x_m, sum_y_m, sum_z_m, weight;
  LaneFloats normal_x, normal_y, normal_z, offset_m, before_m, behind_m;
  /// The sensor's voxel, relative to the first voxel of the 3^3 blocks around the block in which the ray ends.
  std::array<std::int32_t, kRayLanes> from_corner_x, from_corner_y, from_corner_z;
};

struct RayGrid {
  float voxel_size_m, truncation_m;
  float offset_x_vox, offset_y_vox, offset_z_vox;  ///< of the sensor within its voxel, 0..1
};

/// The voxels that rays cross within their bands (see RayBand), by step; each step has one voxel per lane.
struct WalkedVoxels {
  /// The band is at most one block's side long before and behind the end, so a ray crosses at most 2 * 8 * sqrt(3) + 3,
  /// or 30, borders. A ray that crosses more, because of rounding far from its sensor, is cut short.
  static constexpr std::size_t kMostSteps = 40;
  /// Index of a voxel: its block (x + 3 y + 9 z of 3^3, 13 is the middle one) times kBlockVoxels, plus the voxel in the
  /// block, plus kLabelled if labels are written, too. kNone: no voxel, or one that is not written.
  static constexpr std::int32_t kNone = -1, kLabelled = 1 << 14;

  std::array<std::int32_t, kRayLanes> num_steps;
  std::array<std::array<std::int32_t, kRayLanes>, kMostSteps> voxel;
  std::array<LaneFloats, kMostSteps> distance_m;  ///< of its centre from the bundle's plane
};

/// Walks the rays, as GridRay does for one ray, and computes the distances of the crossed voxels from their planes, as
/// DistanceToPlane does. Voxels with centres beyond the end of the band are kNone, and so are voxels that rounding
/// would put outside the 3^3 blocks. Labels are written within the truncation along the ray, including the voxel in
/// which it begins. Vectorised; the result is the same with every instruction set.
void WalkRays(const RayGrid& grid, const RayLanes& rays, WalkedVoxels& walked);

}  // namespace dhpmap
