// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/space/cell.h"

namespace dhpmap {

// The vectorised parts of a LiDAR's look: the same results with every instruction set.

// Directions are told apart by azimuth, from -pi, in bins of 0.2 degrees, and by the sine of the elevation, in bins of
// 0.1 degrees at the horizon: the ground of a scan changes its range fast with the elevation.
inline constexpr int kAzimuthBins = 1800;
inline constexpr int kElevationBins = 1146;

/// How a return becomes a limit.
struct ReturnRule {
  double margin_m, max_range_m, voxel_size_m;
};
/// What is said of each point.
struct ReturnPlaces {
  std::int32_t *columns, *rows;  ///< bins; a row of -1: no return
  float* limits_vox;             ///< how far it lets us see
};
/// Of `num` points, x, y and z of each in turn, in the scanner's frame.
void PlaceReturns(const float* points_m, std::size_t num, const ReturnRule& rule, const ReturnPlaces& places);

/// Each bin of a row takes the least of the nine around, or 0 where one of them is kNoLimit. The row goes around;
/// `least` is scratch of `width` + 2.
void SpreadRow(const float* above, const float* row, const float* below, int width, float* least, float* limit);

/// The scanner on the grid: p_sensor = R p_grid, in voxels.
struct LidarGeometry {
  float R[3][3];
  int first_row, first_column, width;                      ///< of the image, in bins
  float first_u, last_u, last_v;                           ///< azimuths of the image; the greatest row within it
  std::array<std::array<float, kOctantVoxels>, 3> voxels;  ///< of an octant, from its first
};

/// A direction as fractional bins; both within 0 and the number of bins. Of (0, 0, 0): some bin.
struct Direction {
  float azimuth, elevation;
};
Direction DirectionOf(float x, float y, float z);

/// Where cells lie in the image: of their voxel centres, the least and greatest range, and bins. Azimuths below 0 or
/// beyond the last bin: the cell is cut by the image's edge, or surrounds the scanner's axis.
struct LidarBounds {
  alignas(32) std::array<float, kLanes> near, far, azimuth0, azimuth1, elevation0, elevation1;
};
void BoundCells(const CellBatch& cells, const LidarGeometry& geometry, LidarBounds& bounds);
/// The same of all of a ball.
void BoundBalls(const BallBatch& balls, const LidarGeometry& geometry, LidarBounds& bounds);

/// Which voxels of an octant, whose first voxel's centre is given, lie before the limit: 1 or 0 a voxel, x fastest.
void TestOctant(float x, float y, float z, const LidarGeometry& geometry, const float* limit_vox,
                std::array<std::uint8_t, kOctantVoxels>& is_free);

}  // namespace dhpmap
