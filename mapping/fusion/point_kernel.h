// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/map/map_config.h"

namespace dhpmap {

/// Nearer than any sensor measures. A point's weight may go with 1 / depth^2, which must stay finite.
inline constexpr float kLeastDepth_m = 1e-3f;

/// What a row of depth pixels needs to become points on a grid. A pixel's ray, along the axes of the grid, is
/// column[u] + row; its squared length for unit depth is column_length2[u] + row_length2.
struct RowGeometry {
  const float* column_x;
  const float* column_y;
  const float* column_z;
  const float* column_length2;
  float row_x, row_y, row_z, row_length2;
  /// Sensor origin within its voxel, in voxels (0..1), and its voxel.
  float offset_x_vox, offset_y_vox, offset_z_vox;
  std::int32_t base_x, base_y, base_z;
  float voxels_per_m;
  float min_range2_m2, max_range2_m2;
  Weighting weighting;
};

/// One value a pixel; weight 0 marks a pixel without a valid point.
struct RowPoints {
  float* weighted_x_m;  ///< relative to the sensor's origin
  float* weighted_y_m;
  float* weighted_z_m;
  float* weight;
  std::int32_t* voxel_x;
  std::int32_t* voxel_y;
  std::int32_t* voxel_z;
};

/// Projects `width` pixels. Vectorised; the same result with every instruction set.
void ProjectRow(const float* depth_m, int width, const RowGeometry& geometry, const RowPoints& points);

/// For each pixel, and 0 for the one behind the last, whether it goes on with the one before it: both have a point, in
/// the same voxel and segment. `segments` may be null.
void MarkRuns(const RowPoints& points, const std::uint32_t* segments, int width, std::uint8_t* goes_on);

}  // namespace dhpmap
