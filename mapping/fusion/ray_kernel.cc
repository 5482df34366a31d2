// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/ray_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/base/floor_to_int.h"
#include "mapping/base/vector_clones.h"
#include "mapping/fusion/ray_band.h"

namespace dhpmap {
namespace {

constexpr int kLanes = static_cast<int>(kRayLanes);
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Largest distance of a crossed voxel's centre from the ray.
constexpr float kHalfDiagonal_vox = 0.87f;

/// State of the lanes along one axis.
struct AxisLanes {
  float direction[kRayLanes], t_next[kRayLanes], t_step[kRayLanes], along_step_m[kRayLanes], across_step_m[kRayLanes];
  float centre_m[kRayLanes];
  std::int32_t index[kRayLanes], sense[kRayLanes];
};

/// State of the lanes common to all axes.
struct Lanes {
  float range_m[kRayLanes], from_m[kRayLanes], to_m[kRayLanes], along_m[kRayLanes], across_m[kRayLanes];
  std::int32_t num_voxels[kRayLanes];
  AxisLanes x, y, z;
};

DHPMAP_ALWAYS_INLINE void FindBands(const RayGrid& grid, const RayLanes& rays, Lanes& lanes) {
  const float truncation_m = grid.truncation_m;
  const float across_m = std::min(truncation_m, RayBand::kCellReach_vox * grid.voxel_size_m);
  for (int i = 0; i < kLanes; ++i) {
    const float x = rays.sum_x_m[i] / rays.weight[i], y = rays.sum_y_m[i] / rays.weight[i],
                z = rays.sum_z_m[i] / rays.weight[i];
    const float range_m = std::sqrt(x * x + (y * y + z * z));
    const float dx = x / range_m, dy = y / range_m, dz = z / range_m;
    const float cosine = -(rays.normal_x[i] * dx + (rays.normal_y[i] * dy + rays.normal_z[i] * dz));
    const float wanted_m = across_m / cosine;
    const float before_m = wanted_m < rays.before_m[i] ? wanted_m : rays.before_m[i];
    const float behind_m = wanted_m < rays.behind_m[i] ? wanted_m : rays.behind_m[i];
    const float from_m = range_m - (before_m > truncation_m ? before_m : truncation_m);
    lanes.range_m[i] = range_m;
    lanes.from_m[i] = from_m > 0.0f ? from_m : 0.0f;
    lanes.to_m[i] = range_m + (behind_m > truncation_m ? behind_m : truncation_m);
    lanes.x.direction[i] = dx, lanes.y.direction[i] = dy, lanes.z.direction[i] = dz;
    lanes.num_voxels[i] = 1;
    lanes.along_m[i] = 0;
  }
}

/// See the constructors of GridRay and DistanceToPlane.
DHPMAP_ALWAYS_INLINE void BeginAlong(const RayGrid& grid, float offset_vox, const LaneFloats& normal, Lanes& lanes,
                                     AxisLanes& axis) {
  const float voxel_size_m = grid.voxel_size_m, voxels_per_m = 1.0f / grid.voxel_size_m;
  for (int i = 0; i < kLanes; ++i) {
    const float d = axis.direction[i];
    const float start_vox = offset_vox + lanes.from_m[i] * voxels_per_m * d;
    const float end_vox = offset_vox + lanes.to_m[i] * voxels_per_m * d;
    const std::int32_t index = FloorToInt(start_vox);
    const std::int32_t borders = FloorToInt(end_vox) - index;
    const auto first = static_cast<float>(index);
    const float to_border_vox = d < 0 ? start_vox - first : static_cast<float>(index + 1) - start_vox;
    const float length = std::abs(d);
    const float per_voxel = 1.0f / (d == 0 ? 1.0f : length);
    const float centre_vox = first + 0.5f - offset_vox;
    lanes.num_voxels[i] += borders < 0 ? -borders : borders;
    lanes.along_m[i] += centre_vox * d * voxel_size_m;
    axis.index[i] = index;
    axis.sense[i] = d < 0 ? -1 : 1;
    axis.t_step[i] = d == 0 ? kInfinite : per_voxel;
    axis.t_next[i] = d == 0 ? kInfinite : to_border_vox * per_voxel;
    axis.along_step_m[i] = length * voxel_size_m;
    axis.across_step_m[i] = normal[i] * (d < 0 ? -1.0f : 1.0f) * voxel_size_m;
    axis.centre_m[i] = centre_vox * voxel_size_m;
  }
}

DHPMAP_ALWAYS_INLINE void TellVoxels(const RayGrid& grid, const RayLanes& rays, const Lanes& lanes, std::int32_t step,
                                     std::int32_t* __restrict voxel, float* __restrict distance_m) {
  constexpr auto kAround = static_cast<std::uint32_t>(3 * kBlockSide);
  constexpr std::int32_t kInBlock = kBlockSide - 1;
  const float truncation_m = grid.truncation_m;
  const float farthest_m = truncation_m + kHalfDiagonal_vox * grid.voxel_size_m;
  for (int i = 0; i < kLanes; ++i) {
    const std::int32_t x = lanes.x.index[i] + rays.from_corner_x[i], y = lanes.y.index[i] + rays.from_corner_y[i],
                       z = lanes.z.index[i] + rays.from_corner_z[i];
    const std::int32_t block = (x >> kBlockSideLog2) + 3 * ((y >> kBlockSideLog2) + 3 * (z >> kBlockSideLog2));
    const std::int32_t linear =
        (x & kInBlock) | (y & kInBlock) << kBlockSideLog2 | (z & kInBlock) << (2 * kBlockSideLog2);
    const float before_m = lanes.range_m[i] - lanes.along_m[i];
    const bool is_labelled = (before_m > -truncation_m) & (before_m <= farthest_m);
    const bool is_crossed = (step < lanes.num_voxels[i]) & (lanes.along_m[i] < lanes.to_m[i]) &
                            (static_cast<std::uint32_t>(x) < kAround) & (static_cast<std::uint32_t>(y) < kAround) &
                            (static_cast<std::uint32_t>(z) < kAround);
    const std::int32_t code = block * kBlockVoxels + linear + (is_labelled ? WalkedVoxels::kLabelled : 0);
    voxel[i] = is_crossed ? code : WalkedVoxels::kNone;
    distance_m[i] = lanes.across_m[i];
  }
}

/// See GridRay::Next.
DHPMAP_ALWAYS_INLINE void GoOn(Lanes& lanes) {
  for (int i = 0; i < kLanes; ++i) {
    const float x = lanes.x.t_next[i], y = lanes.y.t_next[i], z = lanes.z.t_next[i];
    const bool is_x = (x < y) & (x < z);
    const bool is_y = !(x < y) & (y < z);
    const bool is_z = !is_x & !is_y;
    lanes.x.t_next[i] = x + (is_x ? lanes.x.t_step[i] : 0.0f);
    lanes.y.t_next[i] = y + (is_y ? lanes.y.t_step[i] : 0.0f);
    lanes.z.t_next[i] = z + (is_z ? lanes.z.t_step[i] : 0.0f);
    lanes.x.index[i] += is_x ? lanes.x.sense[i] : 0;
    lanes.y.index[i] += is_y ? lanes.y.sense[i] : 0;
    lanes.z.index[i] += is_z ? lanes.z.sense[i] : 0;
    lanes.along_m[i] += is_x ? lanes.x.along_step_m[i] : is_y ? lanes.y.along_step_m[i] : lanes.z.along_step_m[i];
    lanes.across_m[i] += is_x ? lanes.x.across_step_m[i] : is_y ? lanes.y.across_step_m[i] : lanes.z.across_step_m[i];
  }
}

}  // namespace

DHPMAP_WIDE_VECTOR_CLONES
void WalkRays(const RayGrid& grid, const RayLanes& rays, WalkedVoxels& walked) {
  Lanes lanes;
  FindBands(grid, rays, lanes);
  BeginAlong(grid, grid.offset_x_vox, rays.normal_x, lanes, lanes.x);
  BeginAlong(grid, grid.offset_y_vox, rays.normal_y, lanes, lanes.y);
  BeginAlong(grid, grid.offset_z_vox, rays.normal_z, lanes, lanes.z);
  std::int32_t most = 0;
  for (int i = 0; i < kLanes; ++i) {
    const float dot = rays.normal_x[i] * lanes.x.centre_m[i] +
                      (rays.normal_y[i] * lanes.y.centre_m[i] + rays.normal_z[i] * lanes.z.centre_m[i]);
    lanes.across_m[i] = dot + rays.offset_m[i];
    most = std::max(most, lanes.num_voxels[i]);
    walked.num_steps[i] = lanes.num_voxels[i];
  }
  most = std::min(most, static_cast<std::int32_t>(WalkedVoxels::kMostSteps));
  for (std::int32_t step = 0; step < most; ++step) {
    const auto s = static_cast<std::size_t>(step);
    TellVoxels(grid, rays, lanes, step, walked.voxel[s].data(), walked.distance_m[s].data());
    GoOn(lanes);
  }
  for (int i = 0; i < kLanes; ++i) walked.num_steps[i] = std::min(walked.num_steps[i], most);
}

}  // namespace dhpmap
