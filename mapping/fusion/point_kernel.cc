// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_kernel.h"

#include "mapping/base/floor_to_int.h"
#include "mapping/base/vector_clones.h"

namespace dhpmap {

DHPMAP_WIDE_VECTOR_CLONES
void ProjectRow(const float* __restrict depth_m, const std::uint32_t* __restrict segments, int width,
                const RowGeometry& geometry, const RowPoints& points) {
  const RowGeometry g = geometry;
  const float* __restrict column_x = g.column_x;
  const float* __restrict column_y = g.column_y;
  const float* __restrict column_z = g.column_z;
  const float* __restrict column_length2 = g.column_length2;
  float* __restrict weighted_m = points.weighted_m;
  std::int32_t* __restrict places = points.places;
  std::uint32_t* __restrict numbers = points.numbers;
  const bool by_depth = g.weighting == Weighting::kInverseDepthSquared;
  const bool by_range = g.weighting == Weighting::kInverseRangeSquared;

  DHPMAP_NOTHING_OVERLAPS
  for (int u = 0; u < width; ++u) {
    const float depth = depth_m[u];
    const float length2 = column_length2[u] + g.row_length2;
    const float range2 = depth * depth * length2;
    // False for NaN and infinity, too. min_range may be 0, so the depth is tested separately.
    const bool valid = (depth >= kLeastDepth_m) & (range2 >= g.min_range2_m2) & (range2 <= g.max_range2_m2);
    const float z = valid ? depth : 1.0f;
    const float divisor = by_depth ? z * z : (by_range ? z * z * length2 : 1.0f);
    const float w = valid ? 1.0f / divisor : 0.0f;
    const float x_m = z * (column_x[u] + g.row_x);
    const float y_m = z * (column_y[u] + g.row_y);
    const float z_m = z * (column_z[u] + g.row_z);
    weighted_m[4 * u] = w;
    weighted_m[4 * u + 1] = w * x_m;
    weighted_m[4 * u + 2] = w * y_m;
    weighted_m[4 * u + 3] = w * z_m;
    const std::int32_t voxel_x = FloorToInt(x_m * g.voxels_per_m + g.offset_x_vox) + g.base_x;
    const std::int32_t voxel_y = FloorToInt(y_m * g.voxels_per_m + g.offset_y_vox) + g.base_y;
    const std::int32_t voxel_z = FloorToInt(z_m * g.voxels_per_m + g.offset_z_vox) + g.base_z;
    const auto segment = static_cast<std::int32_t>(segments[u]);
    places[4 * u] = segment;
    places[4 * u + 1] = voxel_x;
    places[4 * u + 2] = voxel_y;
    places[4 * u + 3] = voxel_z;
    const std::uint32_t number = PlaceNumber(segment, voxel_x, voxel_y, voxel_z);
    numbers[u] = valid ? number : RowPoints::kNoPoint;
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void WeighColors(const Color* __restrict colors, const float* __restrict point, int width, float* __restrict weighted) {
  if (colors == nullptr) {
    DHPMAP_NOTHING_OVERLAPS
    for (int u = 0; u < width; ++u) {
      const float grey = point[4 * u] * static_cast<float>(kNoColor);
      weighted[4 * u] = weighted[4 * u + 1] = weighted[4 * u + 2] = grey;
      weighted[4 * u + 3] = 1.0f;
    }
    return;
  }
  DHPMAP_NOTHING_OVERLAPS
  for (int u = 0; u < width; ++u) {
    const float w = point[4 * u];
    weighted[4 * u] = w * static_cast<float>(colors[u].r);
    weighted[4 * u + 1] = w * static_cast<float>(colors[u].g);
    weighted[4 * u + 2] = w * static_cast<float>(colors[u].b);
    weighted[4 * u + 3] = 1.0f;
  }
}

}  // namespace dhpmap
