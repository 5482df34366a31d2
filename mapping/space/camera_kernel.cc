// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/camera_kernel.h"

#include <cmath>
#include <limits>

#include "mapping/base/vector_clones.h"

namespace dhpmap {

const float kNoLimit = std::numeric_limits<float>::infinity();

namespace {

constexpr float kMissing = std::numeric_limits<float>::infinity();
constexpr float kLeastReturn_m = 1e-3f;  // below the range of every sensor
constexpr float kLeastDepth_vox = 1e-3f;

}  // namespace

DHPMAP_WIDE_VECTOR_CLONES
void LimitRow(const float* __restrict depth0_m, const float* __restrict depth1_m, int width,
              const LimitRowGeometry& geometry, float* __restrict limit) {
  const float* __restrict column_length2 = geometry.column_length2;
  const float row_length2 = geometry.row_length2, margin = geometry.margin_m, max_range = geometry.max_range_m;
  const float voxels_per_m = geometry.voxels_per_m;
  for (int u = 0; u < width; ++u) {
    const float a = depth0_m[2 * u], b = depth0_m[2 * u + 1], c = depth1_m[2 * u], d = depth1_m[2 * u + 1];
    // NaN and infinity are not returns.
    const float a1 = a >= kLeastReturn_m ? a : kMissing, b1 = b >= kLeastReturn_m ? b : kMissing;
    const float c1 = c >= kLeastReturn_m ? c : kMissing, d1 = d >= kLeastReturn_m ? d : kMissing;
    const float count = (a1 < kMissing ? 1.0f : 0.0f) + (b1 < kMissing ? 1.0f : 0.0f) + (c1 < kMissing ? 1.0f : 0.0f) +
                        (d1 < kMissing ? 1.0f : 0.0f);
    const float ab = a1 < b1 ? a1 : b1, cd = c1 < d1 ? c1 : d1;
    const float depth = ab < cd ? ab : cd;
    const float per_range = 1.0f / std::sqrt(column_length2[u] + row_length2);  // depth for a range of 1
    const float before = depth - margin * per_range, most = max_range * per_range;
    const float nearer = before < most ? before : most;
    const float seen = (nearer > 0.0f ? nearer : 0.0f) * voxels_per_m;
    limit[u] = count >= 3.0f ? seen : kMissing;
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void CloseRow(const float* __restrict above, const float* __restrict row, const float* __restrict below, int width,
              float* __restrict least, float* __restrict count, float* __restrict closed) {
  for (int u = 0; u < width + 2; ++u) {
    const float a = above[u], b = row[u], c = below[u];
    const float ab = a < b ? a : b;
    least[u] = ab < c ? ab : c;
    count[u] = (a < kMissing ? 1.0f : 0.0f) + (b < kMissing ? 1.0f : 0.0f) + (c < kMissing ? 1.0f : 0.0f);
  }
  for (int u = 0; u < width; ++u) {
    const float ab = least[u] < least[u + 1] ? least[u] : least[u + 1];
    const float around = ab < least[u + 2] ? ab : least[u + 2];
    const float filled = count[u] + count[u + 1] + count[u + 2] >= 4.0f ? around : 0.0f;
    closed[u] = row[u + 1] < kMissing ? row[u + 1] : filled;
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void BoundCells(const CellBatch& cells, const CameraGeometry& geometry, CellBounds& bounds) {
  const CameraGeometry& g = geometry;
  const auto& corners = g.corners[static_cast<std::size_t>(cells.size)];
  float px[kLanes], py[kLanes], pz[kLanes];
  float near[kLanes], far[kLanes], x0[kLanes], x1[kLanes], y0[kLanes], y1[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    px[i] = g.R[0][0] * cells.x[i] + g.R[0][1] * cells.y[i] + g.R[0][2] * cells.z[i];
    py[i] = g.R[1][0] * cells.x[i] + g.R[1][1] * cells.y[i] + g.R[1][2] * cells.z[i];
    pz[i] = g.R[2][0] * cells.x[i] + g.R[2][1] * cells.y[i] + g.R[2][2] * cells.z[i];
    near[i] = x0[i] = y0[i] = kMissing;
    far[i] = x1[i] = y1[i] = -kMissing;
  }
  for (std::size_t corner = 0; corner < kLanes; ++corner) {
    const float cx = corners[0][corner], cy = corners[1][corner], cz = corners[2][corner];
    for (int i = 0; i < kLanes; ++i) {
      const float depth = pz[i] + cz;
      const float per_depth = 1.0f / depth;
      const float x = (px[i] + cx) * per_depth, y = (py[i] + cy) * per_depth;
      near[i] = depth < near[i] ? depth : near[i];
      far[i] = depth > far[i] ? depth : far[i];
      x0[i] = x < x0[i] ? x : x0[i];
      x1[i] = x > x1[i] ? x : x1[i];
      y0[i] = y < y0[i] ? y : y0[i];
      y1[i] = y > y1[i] ? y : y1[i];
    }
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    bounds.near[i] = near[i];
    bounds.far[i] = far[i];
    bounds.u0[i] = g.fx * x0[i] + g.cx;
    bounds.u1[i] = g.fx * x1[i] + g.cx;
    bounds.v0[i] = g.fy * y0[i] + g.cy;
    bounds.v1[i] = g.fy * y1[i] + g.cy;
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void BoundBalls(const BallBatch& balls, const CameraGeometry& geometry, CellBounds& bounds) {
  const CameraGeometry& g = geometry;
  float near[kLanes], far[kLanes], x0[kLanes], x1[kLanes], y0[kLanes], y1[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const float x = g.R[0][0] * balls.x[i] + g.R[0][1] * balls.y[i] + g.R[0][2] * balls.z[i];
    const float y = g.R[1][0] * balls.x[i] + g.R[1][1] * balls.y[i] + g.R[1][2] * balls.z[i];
    const float z = g.R[2][0] * balls.x[i] + g.R[2][1] * balls.y[i] + g.R[2][2] * balls.z[i];
    const float r = balls.radius[i];
    near[i] = z - r;
    far[i] = z + r;
    // A cube around it, along the camera's axes.
    const float per_near = 1.0f / near[i], per_far = 1.0f / far[i];
    const float left = x - r, right = x + r, up = y - r, down = y + r;
    x0[i] = left * per_near < left * per_far ? left * per_near : left * per_far;
    x1[i] = right * per_near > right * per_far ? right * per_near : right * per_far;
    y0[i] = up * per_near < up * per_far ? up * per_near : up * per_far;
    y1[i] = down * per_near > down * per_far ? down * per_near : down * per_far;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    bounds.near[i] = near[i];
    bounds.far[i] = far[i];
    bounds.u0[i] = g.fx * x0[i] + g.cx;
    bounds.u1[i] = g.fx * x1[i] + g.cx;
    bounds.v0[i] = g.fy * y0[i] + g.cy;
    bounds.v1[i] = g.fy * y1[i] + g.cy;
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void TestOctant(float x, float y, float z, const CameraGeometry& geometry, const float* __restrict limit_vox,
                std::array<std::uint8_t, kOctantVoxels>& is_free) {
  const CameraGeometry& g = geometry;
  const float px = g.R[0][0] * x + g.R[0][1] * y + g.R[0][2] * z;
  const float py = g.R[1][0] * x + g.R[1][1] * y + g.R[1][2] * z;
  const float pz = g.R[2][0] * x + g.R[2][1] * y + g.R[2][2] * z;
  const float fx = g.fx, fy = g.fy, cx = g.cx, cy = g.cy;
  const float last_u = g.last_u, last_v = g.last_v;
  const std::int32_t stride = g.width;
  const float* __restrict dx = g.voxels[0].data();
  const float* __restrict dy = g.voxels[1].data();
  const float* __restrict dz = g.voxels[2].data();
  float depths[kOctantVoxels], limits[kOctantVoxels];
  std::int32_t pixels[kOctantVoxels];
  for (int i = 0; i < kOctantVoxels; ++i) {
    const float depth = pz + dz[i];
    const float per_depth = 1.0f / depth;
    const float u = fx * ((px + dx[i]) * per_depth) + cx;
    const float v = fy * ((py + dy[i]) * per_depth) + cy;
    // Out of view, also for NaN: use some pixel, and a depth that is before no limit.
    const float right = u > 0.0f ? u : 0.0f, down = v > 0.0f ? v : 0.0f;
    const float column = right < last_u ? right : last_u, row = down < last_v ? down : last_v;
    const float before = depth > kLeastDepth_vox ? depth : kMissing;
    const float within = column == u ? before : kMissing;
    depths[i] = row == v ? within : kMissing;
    pixels[i] = static_cast<std::int32_t>(row) * stride + static_cast<std::int32_t>(column);
  }
  for (int i = 0; i < kOctantVoxels; ++i) limits[i] = limit_vox[pixels[i]];
  for (std::size_t i = 0; i < kOctantVoxels; ++i) is_free[i] = depths[i] < limits[i] ? 1 : 0;
}

}  // namespace dhpmap
