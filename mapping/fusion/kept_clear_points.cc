// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/kept_clear_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace dhpmap {
namespace {

/// Margin of bounds computed in floats, relative and in metres.
constexpr double kSlack = 1e-5;

/// A region in the sensor's frame: a sphere around all of it.
struct SeenRegion {
  const Region& region;
  Eigen::Vector3d center_m;
  double radius_m;
};

SeenRegion Seen(const Region& region, const Transform& T_sensor_map) {
  const BoundingSphere sphere = SphereAround(region);
  const Eigen::Vector3d center_m = T_sensor_map * sphere.center_m;
  return {region, center_m, sphere.radius_m + kSlack * (1 + center_m.norm())};
}

/// Pixels in [first, last).
struct PixelRange {
  int first_px, last_px;
};

/// The pixels along one axis that may see part of a sphere. `center_m`: its centre along that axis.
PixelRange PixelsOf(const SeenRegion& seen, double center_m, double focal_px, double middle_px, int size_px) {
  const double near_m = seen.center_m.z() - seen.radius_m, far_m = seen.center_m.z() + seen.radius_m;
  if (far_m <= 0) return {0, 0};
  const double low_m = center_m - seen.radius_m, high_m = center_m + seen.radius_m;
  if (near_m <= kSlack * far_m) return {0, size_px};  // the camera may be inside
  const double low_px = middle_px + focal_px * std::min(low_m / near_m, low_m / far_m);
  const double high_px = middle_px + focal_px * std::max(high_m / near_m, high_m / far_m);
  const auto clamped = [size_px](double px) { return static_cast<int>(std::clamp(px, 0.0, double{1} * size_px)); };
  return {clamped(std::floor(low_px)), clamped(std::ceil(high_px) + 1)};
}

/// Whether any of the depths lies in the range. Tests many at a time, since most rows have none. The bounds exceed
/// their rounding errors.
bool HasDepthWithin(double near_m, double far_m, const float* depth_m, int count) {
  const auto least_m =
      std::max(static_cast<float>(near_m * (1 - kSlack)), std::numeric_limits<float>::denorm_min());  // 0: no return
  const auto most_m = static_cast<float>(far_m * (1 + kSlack));
  int num_within = 0;
  for (int i = 0; i < count; ++i)
    num_within += static_cast<int>(depth_m[i] >= least_m) & static_cast<int>(depth_m[i] <= most_m);
  return num_within > 0;
}

/// Calls cut(pixel) for every pixel that sees a point within the region.
template <typename Cut>
void VisitPixelsIn(const SeenRegion& seen, const DepthCameraData& image, const Transform& T_map_sensor, Cut&& cut) {
  const PinholeCamera& camera = image.camera;
  const PixelRange us = PixelsOf(seen, seen.center_m.x(), camera.fx_px, camera.cx_px, camera.width_px);
  const PixelRange vs = PixelsOf(seen, seen.center_m.y(), camera.fy_px, camera.cy_px, camera.height_px);
  const double near_m = std::max(seen.center_m.z() - seen.radius_m, 0.0);
  const double far_m = seen.center_m.z() + seen.radius_m;
  for (int v = vs.first_px; v < vs.last_px; ++v) {
    const float* row_m = image.depth_m.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px);
    if (!HasDepthWithin(near_m, far_m, row_m + us.first_px, us.last_px - us.first_px)) continue;
    for (int u = us.first_px; u < us.last_px; ++u) {
      const std::size_t pixel =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px) + static_cast<std::size_t>(u);
      const double depth_m = static_cast<double>(image.depth_m[pixel]);
      if (!(depth_m > 0 && depth_m >= near_m && depth_m <= far_m)) continue;
      const Eigen::Vector3d p_m((u - camera.cx_px) / camera.fx_px * depth_m,
                                (v - camera.cy_px) / camera.fy_px * depth_m, depth_m);
      if (Contains(seen.region, T_map_sensor * p_m)) cut(pixel);
    }
  }
}

/// Nothing if no pixel sees a point within the regions.
std::optional<PanopticFrame> WithoutPixelsIn(const std::vector<SeenRegion>& regions, const PanopticFrame& frame) {
  std::optional<PanopticFrame> rest;
  for (const SeenRegion& seen : regions) {
    // Pixels cut by one region have no return for the next, so overlapping regions cost little more than one.
    const DepthCameraData& image = rest ? *rest->camera : *frame.camera;
    VisitPixelsIn(seen, image, frame.T_map_sensor, [&rest, &frame](std::size_t pixel) {
      if (!rest) rest.emplace(frame);
      rest->camera->depth_m[pixel] = 0;
    });
  }
  return rest;
}

bool IsInRegion(const SeenRegion& seen, const Eigen::Vector3d& p_m, const Transform& T_map_sensor) {
  return (p_m - seen.center_m).squaredNorm() <= seen.radius_m * seen.radius_m &&
         Contains(seen.region, T_map_sensor * p_m);
}

/// The points of a scan within the regions, in ascending order.
std::vector<std::size_t> PointsIn(const std::vector<SeenRegion>& regions, const PanopticFrame& frame) {
  std::vector<std::size_t> points;
  const std::vector<Eigen::Vector3f>& all = frame.lidar->points_m;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::Vector3d p_m = all[i].cast<double>();
    const bool is_in = std::any_of(regions.begin(), regions.end(),
                                   [&](const SeenRegion& seen) { return IsInRegion(seen, p_m, frame.T_map_sensor); });
    if (is_in) points.push_back(i);
  }
  return points;
}

/// Removes the values at the ascending indices `which`. An empty column stays empty.
template <typename Value>
void Erase(const std::vector<std::size_t>& which, std::vector<Value>& values) {
  if (values.empty()) return;
  auto next = which.begin();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (next != which.end() && *next == i) ++next;
    else values[kept++] = values[i];
  }
  values.resize(kept);
}

std::optional<PanopticFrame> WithoutPointsIn(const std::vector<SeenRegion>& regions, const PanopticFrame& frame) {
  const std::vector<std::size_t> cut = PointsIn(regions, frame);
  if (cut.empty()) return std::nullopt;
  std::optional<PanopticFrame> rest(frame);
  LidarData& scan = *rest->lidar;
  Erase(cut, scan.points_m);
  Erase(cut, scan.color);
  Erase(cut, scan.segments);
  Erase(cut, scan.is_hidden);
  return rest;
}

}  // namespace

std::optional<PanopticFrame> WithoutKeptClear(const PanopticFrame& frame, const KeptClear& kept_clear) {
  if (kept_clear.empty()) return std::nullopt;
  const Transform T_sensor_map = frame.T_map_sensor.inverse();
  std::vector<SeenRegion> regions;
  for (const KeptClearRegion& region : kept_clear.list()) regions.push_back(Seen(region.region, T_sensor_map));
  return frame.camera ? WithoutPixelsIn(regions, frame) : WithoutPointsIn(regions, frame);
}

}  // namespace dhpmap
