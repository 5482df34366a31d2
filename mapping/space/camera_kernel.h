// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/space/cell.h"

namespace dhpmap {

// The vectorised parts of a depth camera's look: the same results with every instruction set.

/// Marks pixels without a limit until holes are closed.
extern const float kNoLimit;

/// What a row of half-resolution pixels needs. The ray of a pixel is sqrt(column_length2[u] + row_length2) long for
/// unit depth.
struct LimitRowGeometry {
  const float* column_length2;
  float row_length2;
  float margin_m, max_range_m;
  float voxels_per_m;
};

/// From two rows of 2 `width` depths, `width` limits (a depth, in voxels): of the least of 2 x 2 depths, that minus the
/// margin along the ray and at most up to the range; kNoLimit where fewer than three of them are returns.
void LimitRow(const float* depth0_m, const float* depth1_m, int width, const LimitRowGeometry& geometry, float* limit);

/// Closes holes: a pixel without a limit takes the least of its eight neighbours if four of them have one, else 0. The
/// rows have a pixel of kNoLimit before the first and after the last of `width`; `least` and `count` are scratch of
/// `width` + 2.
void CloseRow(const float* above, const float* row, const float* below, int width, float* least, float* count,
              float* closed);

/// The camera on the grid: p_camera = R p_grid, in voxels, and its half-resolution image.
struct CameraGeometry {
  float R[3][3];
  float fx, fy, cx, cy;  ///< of the half-resolution image, its pixel (i, j) covering [i, i+1) x [j, j+1)
  int width, height;
  float last_u, last_v;  ///< the greatest coordinates within the image
  /// Of each size of cell: its outermost voxel centres, and of an octant its voxels, relative to the centre of the cell
  /// and of the first voxel.
  std::array<std::array<std::array<float, kLanes>, 3>, kNumCellSizes> corners;
  std::array<std::array<float, kOctantVoxels>, 3> voxels;
};

/// Where cells lie in the image: of their voxel centres, the least and greatest depth and pixel coordinates. Those are
/// meaningless where `near` is not above 0.
struct CellBounds {
  alignas(32) std::array<float, kLanes> near, far, u0, u1, v0, v1;
};
void BoundCells(const CellBatch& cells, const CameraGeometry& geometry, CellBounds& bounds);
/// The same of all of a ball.
void BoundBalls(const BallBatch& balls, const CameraGeometry& geometry, CellBounds& bounds);

/// Which voxels of an octant, whose first voxel's centre is given, lie before the limit: 1 or 0 a voxel, x fastest.
void TestOctant(float x, float y, float z, const CameraGeometry& geometry, const float* limit_vox,
                std::array<std::uint8_t, kOctantVoxels>& is_free);

}  // namespace dhpmap
