// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/lidar_kernel.h"

#include <cmath>
#include <limits>

#include "mapping/base/vector_clones.h"

namespace dhpmap {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kBinsPerRadian = 0.5f * kAzimuthBins / kPi;
constexpr float kBinsPerSine = 0.5f * kElevationBins;
constexpr float kMissing = std::numeric_limits<float>::infinity();
constexpr float kTiny = 1e-20f;  // keeps 0 / 0 out; no voxel centre is so near

/// atan2 to within 3e-4, in a form that vectorises; within -pi and pi.
inline float Azimuth(float y, float x) {
  const float ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
  const float least = ax < ay ? ax : ay, most = ax < ay ? ay : ax;
  const float q = least / (most + kTiny), s = q * q;
  const float octant = ((-0.0464964749f * s + 0.15931422f) * s - 0.327622764f) * s * q + q;
  const float quadrant = ay > ax ? 0.5f * kPi - octant : octant;
  const float half = x < 0 ? kPi - quadrant : quadrant;
  return y < 0 ? -half : half;
}

inline float AzimuthBin(float azimuth) { return (azimuth + kPi) * kBinsPerRadian; }
inline float ElevationBin(float sine) { return (sine + 1.0f) * kBinsPerSine; }

/// No less than asin(q), for q of 0 to 1.
inline float AngleOf(float q) { return q * (1.0f + 0.571f * q * q); }

}  // namespace

Direction DirectionOf(float x, float y, float z) {
  const float range = std::sqrt(x * x + y * y + z * z);
  return {AzimuthBin(Azimuth(y, x)), ElevationBin(z / (range + kTiny))};
}

DHPMAP_WIDE_VECTOR_CLONES
void SpreadRow(const float* __restrict above, const float* __restrict row, const float* __restrict below, int width,
               float* __restrict least, float* __restrict limit) {
  for (int u = 0; u < width; ++u) {  // what is missing counts as 0
    const float a = above[u] < kMissing ? above[u] : 0.0f, b = row[u] < kMissing ? row[u] : 0.0f;
    const float c = below[u] < kMissing ? below[u] : 0.0f;
    const float ab = a < b ? a : b;
    least[u + 1] = ab < c ? ab : c;
  }
  least[0] = least[width];
  least[width + 1] = least[1];
  for (int u = 0; u < width; ++u) {
    const float ab = least[u] < least[u + 1] ? least[u] : least[u + 1];
    limit[u] = ab < least[u + 2] ? ab : least[u + 2];
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void BoundCells(const CellBatch& cells, const LidarGeometry& geometry, LidarBounds& bounds) {
  const LidarGeometry& g = geometry;
  const float half = HalfSpanOf(cells.size);
  const float radius = half * 1.7320509f;
  // What rounding and the approximations may shift a bin by.
  constexpr float kSlack_bins = 0.2f;
  const float* __restrict xs = cells.x.data();
  const float* __restrict ys = cells.y.data();
  const float* __restrict zs = cells.z.data();
  float near[kLanes], far[kLanes], azimuths[kLanes], elevations[kLanes], wides[kLanes], highs[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const float gx = xs[i], gy = ys[i], gz = zs[i];
    const float x = g.R[0][0] * gx + g.R[0][1] * gy + g.R[0][2] * gz;
    const float y = g.R[1][0] * gx + g.R[1][1] * gy + g.R[1][2] * gz;
    const float z = g.R[2][0] * gx + g.R[2][1] * gy + g.R[2][2] * gz;
    // The range along the axes of the grid, on which the cell is a box.
    const float ax = gx < 0 ? -gx : gx, ay = gy < 0 ? -gy : gy, az = gz < 0 ? -gz : gz;
    const float nx = ax > half ? ax - half : 0.0f, ny = ay > half ? ay - half : 0.0f, nz = az > half ? az - half : 0.0f;
    const float fx = ax + half, fy = ay + half, fz = az + half;
    near[i] = std::sqrt(nx * nx + ny * ny + nz * nz);
    far[i] = std::sqrt(fx * fx + fy * fy + fz * fz);
    const float flat = std::sqrt(x * x + y * y), range = std::sqrt(x * x + y * y + z * z);
    azimuths[i] = AzimuthBin(Azimuth(y, x));
    elevations[i] = ElevationBin(z / (range + kTiny));
    const float round = 2.0f * kAzimuthBins;  // all around, and so beyond both edges
    const float wide = AngleOf(radius / (flat + kTiny)) * kBinsPerRadian + kSlack_bins;
    const float high = AngleOf(radius / (range + kTiny)) * kBinsPerSine + kSlack_bins;
    wides[i] = flat > radius ? wide : round;
    highs[i] = range > radius ? high : round;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    bounds.near[i] = near[i];
    bounds.far[i] = far[i];
    bounds.azimuth0[i] = azimuths[i] - wides[i];
    bounds.azimuth1[i] = azimuths[i] + wides[i];
    bounds.elevation0[i] = elevations[i] - highs[i];
    bounds.elevation1[i] = elevations[i] + highs[i];
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void BoundBalls(const BallBatch& balls, const LidarGeometry& geometry, LidarBounds& bounds) {
  const LidarGeometry& g = geometry;
  constexpr float kSlack_bins = 0.2f;  // as above
  float near[kLanes], far[kLanes], azimuths[kLanes], elevations[kLanes], wides[kLanes], highs[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const float gx = balls.x[i], gy = balls.y[i], gz = balls.z[i], radius = balls.radius[i];
    const float x = g.R[0][0] * gx + g.R[0][1] * gy + g.R[0][2] * gz;
    const float y = g.R[1][0] * gx + g.R[1][1] * gy + g.R[1][2] * gz;
    const float z = g.R[2][0] * gx + g.R[2][1] * gy + g.R[2][2] * gz;
    const float flat = std::sqrt(x * x + y * y), range = std::sqrt(x * x + y * y + z * z);
    near[i] = range - radius;
    far[i] = range + radius;
    azimuths[i] = AzimuthBin(Azimuth(y, x));
    elevations[i] = ElevationBin(z / (range + kTiny));
    const float round = 2.0f * kAzimuthBins;
    const float wide = AngleOf(radius / (flat + kTiny)) * kBinsPerRadian + kSlack_bins;
    const float high = AngleOf(radius / (range + kTiny)) * kBinsPerSine + kSlack_bins;
    wides[i] = flat > radius ? wide : round;
    highs[i] = range > radius ? high : round;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    bounds.near[i] = near[i];
    bounds.far[i] = far[i];
    bounds.azimuth0[i] = azimuths[i] - wides[i];
    bounds.azimuth1[i] = azimuths[i] + wides[i];
    bounds.elevation0[i] = elevations[i] - highs[i];
    bounds.elevation1[i] = elevations[i] + highs[i];
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void TestOctant(float x, float y, float z, const LidarGeometry& geometry, const float* __restrict limit_vox,
                std::array<std::uint8_t, kOctantVoxels>& is_free) {
  const LidarGeometry& g = geometry;
  const float px = g.R[0][0] * x + g.R[0][1] * y + g.R[0][2] * z;
  const float py = g.R[1][0] * x + g.R[1][1] * y + g.R[1][2] * z;
  const float pz = g.R[2][0] * x + g.R[2][1] * y + g.R[2][2] * z;
  const float* __restrict dx = g.voxels[0].data();
  const float* __restrict dy = g.voxels[1].data();
  const float* __restrict dz = g.voxels[2].data();
  const float first_row = static_cast<float>(g.first_row), last_u = g.last_u, last_v = g.last_v;
  float ranges[kOctantVoxels], limits[kOctantVoxels];
  std::int32_t pixels[kOctantVoxels];
  for (int i = 0; i < kOctantVoxels; ++i) {
    const float vx = px + dx[i], vy = py + dy[i], vz = pz + dz[i];
    const float range = std::sqrt(vx * vx + vy * vy + vz * vz);
    const float u = AzimuthBin(Azimuth(vy, vx)), v = ElevationBin(vz / (range + kTiny)) - first_row;
    // Out of view: some bin, and a range that is before no limit. Azimuths are never out of it but for rounding.
    const float right = u > 0.0f ? u : 0.0f, down = v > 0.0f ? v : 0.0f;
    const float column = right < last_u ? right : last_u, row = down < last_v ? down : last_v;
    ranges[i] = row == v ? range : kMissing;
    pixels[i] = static_cast<std::int32_t>(row) * kAzimuthBins + static_cast<std::int32_t>(column);
  }
  for (int i = 0; i < kOctantVoxels; ++i) limits[i] = limit_vox[pixels[i]];
  for (std::size_t i = 0; i < kOctantVoxels; ++i) is_free[i] = ranges[i] < limits[i] ? 1 : 0;
}

}  // namespace dhpmap
