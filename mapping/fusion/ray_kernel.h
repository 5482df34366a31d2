// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/base/grid.h"

namespace dhpmap {

/// So many rays are walked side by side, one a lane.
inline constexpr std::size_t kRayLanes = 16;
using LaneFloats = std::array<float, kRayLanes>;

/// Bundles (see Bundle), one a lane, and where each ends.
struct RayLanes {
  LaneFloats sum_x_m, sum_y_m, sum_z_m, weight;
  LaneFloats normal_x, normal_y, normal_z, offset_m, before_m, behind_m;
  /// The sensor's voxel, from the first one of the 3^3 blocks around the one in which the ray ends.
  std::array<std::int32_t, kRayLanes> from_corner_x, from_corner_y, from_corner_z;
};

struct RayGrid {
  float voxel_size_m, truncation_m;
  float offset_x_vox, offset_y_vox, offset_z_vox;  ///< of the sensor within its voxel, 0..1
};

/// The voxels that rays cross within their bands (see RayBand), in order: those of one step one a lane.
struct WalkedVoxels {
  /// The truncation is at most a block's side, and so are longer bands: a ray crosses at most 2 * 8 * sqrt(3) + 3, so
  /// 30, borders. One so far from its sensor that single precision makes more of it is cut.
  static constexpr std::size_t kMostSteps = 40;
  /// What a voxel is, or kNone: none, or nothing is written there. The block (x + 3 y + 9 z of 3^3, 13 the one in the
  /// middle) times kBlockVoxels, plus the voxel in it; kLabelled if labels are written there, too.
  static constexpr std::int32_t kNone = -1, kLabelled = 1 << 14;

  std::array<std::int32_t, kRayLanes> num_steps;
  std::array<std::array<std::int32_t, kRayLanes>, kMostSteps> voxel;
  std::array<LaneFloats, kMostSteps> distance_m;  ///< of its centre to the bundle's plane
};

/// Walks the rays, as GridRay does one of them, and tells how far what they cross lies before their planes, as
/// DistanceToPlane does. Voxels whose centres lie beyond the end of the band are kNone, and so is what by rounding
/// would lie outside the 3^3 blocks. Labels go within the truncation along the ray, and to the voxel in which that
/// begins. Vectorised; the same result with every instruction set.
void WalkRays(const RayGrid& grid, const RayLanes& rays, WalkedVoxels& walked);

}  // namespace dhpmap
