// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_kernel.h"

// Versions for wider vector units, chosen at load time. Not under sanitizers: those start after the choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DHPMAP_SANITIZED)
#define DHPMAP_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define DHPMAP_VECTOR_CLONES
#endif

namespace dhpmap {
namespace {

/// std::floor for values within int32, in a form that vectorises without SSE4.1.
inline std::int32_t FloorToInt(float value) {
  const auto truncated = static_cast<std::int32_t>(value);
  return truncated - static_cast<std::int32_t>(value < static_cast<float>(truncated));
}

}  // namespace

DHPMAP_VECTOR_CLONES
void ProjectRow(const float* __restrict depth_m, int width, const RowGeometry& geometry, const RowPoints& points) {
  const RowGeometry g = geometry;
  const float* __restrict column_x = g.column_x;
  const float* __restrict column_y = g.column_y;
  const float* __restrict column_z = g.column_z;
  const float* __restrict column_length2 = g.column_length2;
  float* __restrict weighted_x_m = points.weighted_x_m;
  float* __restrict weighted_y_m = points.weighted_y_m;
  float* __restrict weighted_z_m = points.weighted_z_m;
  float* __restrict weight = points.weight;
  std::int32_t* __restrict voxel_x = points.voxel_x;
  std::int32_t* __restrict voxel_y = points.voxel_y;
  std::int32_t* __restrict voxel_z = points.voxel_z;
  const bool by_depth = g.weighting == Weighting::kInverseDepthSquared;
  const bool by_range = g.weighting == Weighting::kInverseRangeSquared;

  for (int u = 0; u < width; ++u) {
    const float depth = depth_m[u];
    const float length2 = column_length2[u] + g.row_length2;
    const float range2 = depth * depth * length2;
    // False for NaN and infinity too; min_range may be 0, so the depth is tested on its own.
    const bool valid = (depth >= kLeastDepth_m) & (range2 >= g.min_range2_m2) & (range2 <= g.max_range2_m2);
    const float z = valid ? depth : 1.0f;
    const float divisor = by_depth ? z * z : (by_range ? z * z * length2 : 1.0f);
    const float w = valid ? 1.0f / divisor : 0.0f;
    const float x_m = z * (column_x[u] + g.row_x);
    const float y_m = z * (column_y[u] + g.row_y);
    const float z_m = z * (column_z[u] + g.row_z);
    weight[u] = w;
    weighted_x_m[u] = w * x_m;
    weighted_y_m[u] = w * y_m;
    weighted_z_m[u] = w * z_m;
    voxel_x[u] = FloorToInt(x_m * g.voxels_per_m + g.offset_x_vox) + g.base_x;
    voxel_y[u] = FloorToInt(y_m * g.voxels_per_m + g.offset_y_vox) + g.base_y;
    voxel_z[u] = FloorToInt(z_m * g.voxels_per_m + g.offset_z_vox) + g.base_z;
  }
}

DHPMAP_VECTOR_CLONES
void MarkRuns(const RowPoints& points, const std::uint32_t* segments, int width, std::uint8_t* goes_on) {
  const float* __restrict weight = points.weight;
  const std::int32_t* __restrict x = points.voxel_x;
  const std::int32_t* __restrict y = points.voxel_y;
  const std::int32_t* __restrict z = points.voxel_z;
  std::uint8_t* __restrict result = goes_on;
  for (int u = 1; u < width; ++u) {
    const std::int32_t other = (x[u] ^ x[u - 1]) | (y[u] ^ y[u - 1]) | (z[u] ^ z[u - 1]);
    result[u] = (other == 0) & (weight[u] != 0.0f) & (weight[u - 1] != 0.0f);
  }
  if (segments != nullptr) {
    for (int u = 1; u < width; ++u) result[u] &= segments[u] == segments[u - 1];
  }
  result[0] = result[width] = 0;
}

}  // namespace dhpmap
