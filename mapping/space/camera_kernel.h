// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/space/cell.h"

namespace dhpmap {

// The vectorised parts of looking through a depth image. Results are the same with every instruction set.

/// Marks pixels without a limit until holes are closed.
extern const float kNoLimit;

/// Geometry of a row of half-resolution pixels. At unit depth, the ray of a pixel is sqrt(column_length2[u] +
/// row_length2) long.
struct LimitRowGeometry {
  const float* column_length2;
  float row_length2;
  float margin_m, max_range_m;
  float voxels_per_m;
};

/// Computes `width` limits (depths, in voxels) from two rows of 2 `width` depths: the minimum of 2 x 2 depths, minus
/// the margin along the ray, at most up to the range; kNoLimit if fewer than three of them are returns.
void LimitRow(const float* depth0_m, const float* depth1_m, int width, const LimitRowGeometry& geometry, float* limit);

/// Closes holes: a pixel without a limit takes the minimum of its eight neighbours if four of them have one, else 0.
/// Each row has a pixel of kNoLimit before the first and after the last of `width`; `least` and `count` are scratch of
/// `width` + 2.
void CloseRow(const float* above, const float* row, const float* below, int width, float* least, float* count,
              float* closed);

/// The camera on the grid: p_camera = R p_grid, in voxels, and its half-resolution image.
struct CameraGeometry {
  float R[3][3];
  float fx, fy, cx, cy;  ///< of the half-resolution image, whose pixel (i, j) covers [i, i+1) x [j, j+1)
  int width, height;
  float last_u, last_v;  ///< the largest coordinates within the image
  /// For each size of cell, its outermost voxel centres relative to its centre; for an octant, all its voxels relative
  /// to the first one.
  std::array<std::array<std::array<float, kLanes>, 3>, kNumCellSizes> corners;
  std::array<std::array<float, kOctantVoxels>, 3> voxels;
};

/// Bounds of cells in the image: minimum and maximum depth and pixel coordinates of their voxel centres. Meaningless
/// unless `near` is above 0.
struct CellBounds {
  alignas(32) std::array<float, kLanes> near, far, u0, u1, v0, v1;
};
void BoundCells(const CellBatch& cells, const CameraGeometry& geometry, CellBounds& bounds);
/// The same for whole balls.
void BoundBalls(const BallBatch& balls, const CameraGeometry& geometry, CellBounds& bounds);

/// Tests the voxels of an octant, given the centre of its first one: 1 if the voxel is before the limit, else 0; x
/// fastest.
void TestOctant(float x, float y, float z, const CameraGeometry& geometry, const float* limit_vox,
                std::array<std::uint8_t, kOctantVoxels>& is_free);

}  // namespace dhpmap
