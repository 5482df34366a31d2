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
constexpr float kTiny = 1e-20f;  // avoids 0 / 0; no voxel centre is so near

/// atan2 with an error below 3e-4, vectorisable; within -pi and pi.
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

/// An upper bound of asin(q) for q in 0 to 1.
inline float AngleOf(float q) { return q * (1.0f + 0.571f * q * q); }

}  // namespace

Direction DirectionOf(float x, float y, float z) {
  const float range = std::sqrt(x * x + y * y + z * z);
  return {AzimuthBin(Azimuth(y, x)), ElevationBin(z / (range + kTiny))};
}

DHPMAP_WIDE_VECTOR_CLONES
void PlaceReturns(const float* __restrict points_m, std::size_t num, const ReturnRule& rule,
                  const ReturnPlaces& places) {
  constexpr double kLeastRange_m = 1e-3;  // below the range of every scanner
  const double margin_m = rule.margin_m, max_range_m = rule.max_range_m, voxel_size_m = rule.voxel_size_m;
  std::int32_t* __restrict columns = places.columns;
  std::int32_t* __restrict rows = places.rows;
  float* __restrict limits_vox = places.limits_vox;
  DHPMAP_NOTHING_OVERLAPS
  for (std::size_t i = 0; i < num; ++i) {
    const double x = points_m[3 * i], y = points_m[3 * i + 1], z = points_m[3 * i + 2];
    const double range = std::sqrt(x * x + (y * y + z * z));
    const double divisor = range >= kLeastRange_m ? range : 1.0;
    const auto rx = static_cast<float>(x / divisor), ry = static_cast<float>(y / divisor);
    const auto rz = static_cast<float>(z / divisor);
    const auto column = static_cast<std::int32_t>(AzimuthBin(Azimuth(ry, rx)));
    const auto row = static_cast<std::int32_t>(ElevationBin(rz / (std::sqrt(rx * rx + ry * ry + rz * rz) + kTiny)));
    const std::int32_t least_column = column > 0 ? column : 0, least_row = row > 0 ? row : 0;
    columns[i] = least_column < kAzimuthBins ? least_column : kAzimuthBins - 1;
    const std::int32_t most_row = least_row < kElevationBins ? least_row : kElevationBins - 1;
    rows[i] = range >= kLeastRange_m ? most_row : -1;
    const double before_m = range - margin_m, least_m = before_m > 0.0 ? before_m : 0.0;
    limits_vox[i] = static_cast<float>((least_m < max_range_m ? least_m : max_range_m) / voxel_size_m);
  }
}

DHPMAP_WIDE_VECTOR_CLONES
void SpreadRow(const float* __restrict above, const float* __restrict row, const float* __restrict below, int width,
               float* __restrict least, float* __restrict limit) {
  for (int u = 0; u < width; ++u) {  // a missing limit counts as 0
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

// Bounds the directions of a cell's voxel centres c + d, where c is the middle. The axes are level across c's azimuth
// (`across`), level along it (`ahead`), across its ray in the vertical plane (`up`), and along its ray (`along`). The
// cell is a box on the grid, so |d| along an axis is at most `half` times the sum of the axis' coordinates on the grid.
// Seen from above, a voxel deviates from c's azimuth by at most across / (flat - ahead). In the vertical plane it
// deviates from the ray by at most `up`, plus the increase of its distance from the vertical axis due to `across`. Its
// range is at least that of c minus `along`.
DHPMAP_WIDE_VECTOR_CLONES
void BoundCells(const CellBatch& cells, const LidarGeometry& geometry, LidarBounds& bounds) {
  const LidarGeometry& g = geometry;
  const float half = HalfSpanOf(cells.size);
  // Upper bound of the shift of a bin by rounding and approximations.
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
    // The range, along the grid's axes, in which the cell is a box.
    const float ax = gx < 0 ? -gx : gx, ay = gy < 0 ? -gy : gy, az = gz < 0 ? -gz : gz;
    const float nx = ax > half ? ax - half : 0.0f, ny = ay > half ? ay - half : 0.0f, nz = az > half ? az - half : 0.0f;
    const float fx = ax + half, fy = ay + half, fz = az + half;
    near[i] = std::sqrt(nx * nx + ny * ny + nz * nz);
    far[i] = std::sqrt(fx * fx + fy * fy + fz * fz);
    const float flat = std::sqrt(x * x + y * y), range = std::sqrt(x * x + y * y + z * z);
    azimuths[i] = AzimuthBin(Azimuth(y, x));
    elevations[i] = ElevationBin(z / (range + kTiny));
    const float per_flat = 1.0f / (flat + kTiny), per_range = 1.0f / (range + kTiny);
    const float cosine = flat * per_range, sine = z * per_range;
    float across = 0, ahead = 0, up = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float beside = (g.R[1][axis] * x - g.R[0][axis] * y) * per_flat;
      const float level = (g.R[0][axis] * x + g.R[1][axis] * y) * per_flat;
      const float upwards = g.R[2][axis] * cosine - level * sine;
      across += half * (beside < 0 ? -beside : beside);
      ahead += half * (level < 0 ? -level : level);
      up += half * (upwards < 0 ? -upwards : upwards);
    }
    const float along = half * (ax + ay + az) * per_range;
    const float from_axis = flat - ahead, from_scanner = range - along;
    const float round = 2.0f * kAzimuthBins;  // beyond both edges of the image
    const float grown = 0.5f * across * across / from_axis;
    const float wide = across / from_axis * kBinsPerRadian + kSlack_bins;
    const float high = (up + grown) / from_scanner * kBinsPerSine + kSlack_bins;
    wides[i] = from_axis > 0 ? wide : round;
    highs[i] = ((from_axis > 0) & (from_scanner > 0)) ? high : round;
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
  const float first_row = static_cast<float>(g.first_row), last_v = g.last_v;
  const float first_u = g.first_u, last_u = g.last_u;
  const std::int32_t first_column = g.first_column, width = g.width;
  float ranges[kOctantVoxels], limits[kOctantVoxels];
  std::int32_t pixels[kOctantVoxels];
  for (int i = 0; i < kOctantVoxels; ++i) {
    const float vx = px + dx[i], vy = py + dy[i], vz = pz + dz[i];
    const float range = std::sqrt(vx * vx + vy * vy + vz * vz);
    const float u = AzimuthBin(Azimuth(vy, vx)), v = ElevationBin(vz / (range + kTiny)) - first_row;
    // Out of view: use some bin, and a range that is before no limit. If the image does not surround the scanner, its
    // outermost columns have no limit.
    const float right = u > first_u ? u : first_u, down = v > 0.0f ? v : 0.0f;
    const float column = right < last_u ? right : last_u, row = down < last_v ? down : last_v;
    ranges[i] = row == v ? range : kMissing;
    pixels[i] = static_cast<std::int32_t>(row) * width + (static_cast<std::int32_t>(column) - first_column);
  }
  for (int i = 0; i < kOctantVoxels; ++i) limits[i] = limit_vox[pixels[i]];
  for (std::size_t i = 0; i < kOctantVoxels; ++i) is_free[i] = ranges[i] < limits[i] ? 1 : 0;
}

}  // namespace dhpmap
