// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/tangent_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mapping/fusion/moment_pyramid.h"

namespace dhpmap {
namespace {

/// Above this cosine the distance along the ray is as good as the distance to the plane.
constexpr float kFaceOnCosine = 0.7f;
/// Below this cosine between ray and normal, the plane's slope is too uncertain to tell where the ray meets it: 3
/// degrees, a road at 30 m.
constexpr float kLeastCosine = 0.05f;
/// A bundle farther from the plane lies on another surface.
constexpr float kMostOffPlane_vox = 0.5f;
/// Half the length of a uniform distribution, in standard deviations.
constexpr float kHalfLength = 1.73f;
/// The blocks around a ray's end reach at least this far.
constexpr float kMostReach_vox = kBlockSide;

/// The windows of one block: at each level, the 2^3 cubes around each corner of its cubes, including cubes of
/// neighbouring blocks.
struct Window {
  std::array<std::uint8_t, 8> neighbour;  ///< in the 3^3 blocks; 13 is the own one
  std::array<std::uint8_t, 8> cube;       ///< in that block
};
constexpr std::array<std::size_t, 4> kFirstWindow = {0, 0, 125, 152};  ///< of each level: 5^3, 3^3, 2^3
constexpr std::size_t kNumWindows = 160;

constexpr std::array<Window, kNumWindows> MakeWindows() {
  std::array<Window, kNumWindows> windows{};
  for (int level = 1; level <= MomentPyramid::kNumLevels; ++level) {
    const int num = kBlockSide >> level;
    const int num3 = (num + 1) * (num + 1) * (num + 1);
    for (int w = 0; w < num3; ++w) {
      const std::array<int, 3> corner = {w % (num + 1), w / (num + 1) % (num + 1), w / (num + 1) / (num + 1)};
      Window& window = windows[kFirstWindow[static_cast<std::size_t>(level)] + static_cast<std::size_t>(w)];
      for (int n = 0; n < 8; ++n) {
        int neighbour = 13, cube = 0, weight = 1, stride = 1;
        for (int axis = 0; axis < 3; ++axis, weight *= 3, stride *= num) {
          const int at = corner[static_cast<std::size_t>(axis)] - 1 + (n >> axis & 1);
          const int step = at < 0 ? -1 : (at >= num ? 1 : 0);
          neighbour += step * weight;
          cube += (at - step * num) * stride;
        }
        window.neighbour[static_cast<std::size_t>(n)] = static_cast<std::uint8_t>(neighbour);
        window.cube[static_cast<std::size_t>(n)] = static_cast<std::uint8_t>(cube);
      }
    }
  }
  return windows;
}
constexpr std::array<Window, kNumWindows> kWindows = MakeWindows();

/// The planes of one block's bundles, each fitted at its first use.
class BlockPlanes {
 public:
  /// `pyramid` is shared scratch memory.
  BlockPlanes(const SegmentBundles& segment, float voxel_size_m, MomentPyramid& pyramid)
      : segment_(segment), voxel_size_m_(voxel_size_m), pyramid_(pyramid) {
    pyramid_.Build(segment);
  }

  void MoveTo(std::size_t cell) {
    block_ = segment_.cells[cell].block;
    cells_around_.fill(kNotLooked);
    cells_around_[13] = static_cast<std::int32_t>(cell);
    is_fitted_.fill(false);
  }

  /// The plane of the narrowest window around the voxel that settles whether there is one.
  const PlaneFit& At(int linear) {
    for (int level = 1; level < MomentPyramid::kNumLevels; ++level) {
      const PlaneFit& fit = InWindow(level, linear);
      if (fit.outcome != PlaneFit::Outcome::kTooFew) return fit;
    }
    return InWindow(MomentPyramid::kNumLevels, linear);
  }

 private:
  static constexpr std::int32_t kNotLooked = -2, kNone = -1;

  const PlaneFit& InWindow(int level, int linear) {
    const int half = 1 << (level - 1), num = (kBlockSide >> level) + 1;
    const int x = ((linear & 7) + half) >> level, y = ((linear >> 3 & 7) + half) >> level,
              z = ((linear >> 6) + half) >> level;
    const std::size_t i =
        kFirstWindow[static_cast<std::size_t>(level)] + static_cast<std::size_t>(x + num * (y + num * z));
    if (!is_fitted_[i]) {
      is_fitted_[i] = true;
      fits_[i] = Fit(level, kWindows[i]);
    }
    return fits_[i];
  }

  PlaneFit Fit(int level, const Window& window) {
    std::array<const PlaneMoments*, 8> cubes;
    std::size_t num_cubes = 0;
    double num_bundles = 0;
    for (std::size_t n = 0; n < 8; ++n) {
      std::int32_t& cell = cells_around_[window.neighbour[n]];
      if (cell == kNotLooked) cell = Look(window.neighbour[n]);
      if (cell == kNone) continue;
      const PlaneMoments* cube = pyramid_.Find(static_cast<std::size_t>(cell), level, window.cube[n]);
      if (cube == nullptr) continue;
      cubes[num_cubes++] = cube;
      num_bundles += cube->num_bundles();
    }
    if (num_bundles < PlaneFit::kLeastBundles) return {};  // true of most windows of a scan: not worth summing up
    PlaneMoments sum = *cubes[0];
    for (std::size_t i = 1; i < num_cubes; ++i) sum.Add(*cubes[i]);
    return FitPlane(sum, voxel_size_m_);
  }

  [[nodiscard]] std::int32_t Look(std::uint8_t neighbour) const {
    const int dx = neighbour % 3 - 1, dy = neighbour / 3 % 3 - 1, dz = neighbour / 9 - 1;
    const BundleCell* cell = segment_.Find({block_.x + dx, block_.y + dy, block_.z + dz});
    return cell == nullptr ? kNone : static_cast<std::int32_t>(cell - segment_.cells.data());
  }

  const SegmentBundles& segment_;
  float voxel_size_m_;
  MomentPyramid& pyramid_;
  BlockIndex block_;
  std::array<std::int32_t, 27> cells_around_{};
  std::array<bool, kNumWindows> is_fitted_{};
  std::array<PlaneFit, kNumWindows> fits_;
};

/// `mean_m` of the fit and the bundle's end are relative to the sensor's origin.
TangentPlane PlaneFor(const Eigen::Vector3f& end_m, const PlaneFit& fit, PointSpacing spacing, float voxel_size_m) {
  const float range_m = end_m.norm();
  const Eigen::Vector3f direction = end_m / range_m;
  TangentPlane across_ray{.normal = -direction, .offset_m = range_m};
  if (fit.outcome != PlaneFit::Outcome::kPlane) return across_ray;
  const float towards = -fit.normal.dot(direction), cosine = std::abs(towards);
  if (cosine < kLeastCosine) return across_ray;
  TangentPlane plane;
  plane.normal = towards > 0 ? fit.normal : -fit.normal;
  plane.offset_m = -plane.normal.dot(fit.mean_m);
  if (std::abs(plane.normal.dot(end_m) + plane.offset_m) > kMostOffPlane_vox * voxel_size_m) return across_ray;
  if (spacing == PointSpacing::kDense || cosine > kFaceOnCosine) return plane;
  // The plane was seen around the fit's mean only; it does not support longer rays.
  const float sine = std::sqrt(1 - cosine * cosine);
  const Eigen::Vector3f in_plane = (direction + plane.normal * cosine) / sine;
  const float seen_m = kHalfLength * fit.SpreadAlong_m(in_plane);
  const float from_mean_m = in_plane.dot(end_m - fit.mean_m);
  const auto reach_m = [&](float along_plane_m) {
    return std::clamp(along_plane_m / sine, 0.0f, kMostReach_vox * voxel_size_m);
  };
  plane.before_m = reach_m(seen_m + from_mean_m);
  plane.behind_m = reach_m(seen_m - from_mean_m);
  return plane;
}

}  // namespace

void FitTangentPlanes(double voxel_size_m, PointSpacing spacing, TangentPlaneRoom& room, SegmentBundles& segment) {
  const auto size_m = static_cast<float>(voxel_size_m);
  BlockPlanes planes(segment, size_m, room.pyramid);
  room.wide.Reset();
  const bool takes_wide =
      spacing == PointSpacing::kScan && static_cast<double>(segment.bundles.size()) >= PlaneFit::kLeastBundles;
  for (std::size_t c = 0; c < segment.cells.size(); ++c) {
    const BundleCell& cell = segment.cells[c];
    planes.MoveTo(c);
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      Bundle& bundle = segment.bundles[b];
      const PlaneFit* fit = &planes.At(bundle.linear);
      if (takes_wide && fit->outcome == PlaneFit::Outcome::kTooFew) {
        fit = &room.wide.At(VoxelIn(cell.block, bundle.linear), segment, room.pyramid, size_m);
      }
      bundle.plane = PlaneFor(bundle.weighted_sum_m / bundle.weight, *fit, spacing, size_m);
    }
  }
}

}  // namespace dhpmap
