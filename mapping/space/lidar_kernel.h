// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/space/cell.h"

namespace dhpmap {

// The vectorised parts of looking through a LiDAR scan. Results are the same with every instruction set.

// Bins of direction: 0.2 degrees of azimuth, from -pi, and equal steps of the sine of elevation, 0.1 degrees at the
// horizon. They are fine in elevation because the range of the ground changes fast with it.
inline constexpr int kAzimuthBins = 1800;
inline constexpr int kElevationBins = 1146;

/// How a return becomes a limit.
struct ReturnRule {
  double margin_m, max_range_m, voxel_size_m;
};
/// The result for each point.
struct ReturnPlaces {
  std::int32_t *columns, *rows;  ///< bins; a row of -1: no return
  float* limits_vox;             ///< the limit of sight
};
/// For `num` points in the scanner's frame: x, y and z of each in turn.
void PlaceReturns(const float* points_m, std::size_t num, const ReturnRule& rule, const ReturnPlaces& places);

/// Each bin of a row takes the minimum of the 3 x 3 bins around it, or 0 if one of them is kNoLimit. The row wraps
/// around; `least` is scratch of `width` + 2.
void SpreadRow(const float* above, const float* row, const float* below, int width, float* least, float* limit);

/// The scanner on the grid: p_sensor = R p_grid, in voxels.
struct LidarGeometry {
  float R[3][3];
  int first_row, first_column, width;                      ///< of the image, in bins
  float first_u, last_u, last_v;                           ///< azimuths of the image; its largest row
  std::array<std::array<float, kOctantVoxels>, 3> voxels;  ///< of an octant, relative to its first
};

/// A direction as fractional bins, each from 0 to the number of bins. For (0, 0, 0): any bin.
struct Direction {
  float azimuth, elevation;
};
Direction DirectionOf(float x, float y, float z);

/// Bounds of cells in the image: minimum and maximum range and bins of their voxel centres. An azimuth below 0 or
/// beyond the last bin: the image's edge cuts the cell, or the cell surrounds the scanner's axis.
struct LidarBounds {
  alignas(32) std::array<float, kLanes> near, far, azimuth0, azimuth1, elevation0, elevation1;
};
void BoundCells(const CellBatch& cells, const LidarGeometry& geometry, LidarBounds& bounds);
/// The same for whole balls.
void BoundBalls(const BallBatch& balls, const LidarGeometry& geometry, LidarBounds& bounds);

/// Tests the voxels of an octant, given the centre of its first one: 1 if the voxel is before the limit, else 0; x
/// fastest.
void TestOctant(float x, float y, float z, const LidarGeometry& geometry, const float* limit_vox,
                std::array<std::uint8_t, kOctantVoxels>& is_free);

}  // namespace dhpmap
