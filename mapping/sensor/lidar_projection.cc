// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/lidar_projection.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mapping/sensor/camera_occlusion.h"

namespace dhpmap {
namespace {

template <typename Pixel>
Status CheckSize(const LidarCamera& camera, const Image<Pixel>& image, const char* field) {
  const bool is_empty = image.width_px == 0 && image.height_px == 0 && image.pixels.empty();
  const bool fits = image.width_px == camera.width_px && image.height_px == camera.height_px &&
                    image.pixels.size() == static_cast<std::size_t>(image.width_px) * image.height_px;
  if (is_empty || fits) return Status::Ok();
  const std::string size = std::to_string(image.width_px) + " x " + std::to_string(image.height_px);
  const std::string wanted = std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px);
  return InvalidArgument("an image beside the LiDAR does not have its camera's size")
      .WithReason("BAD_FRAME")
      .WithViolation(field, "is " + size + " pixels, the camera " + wanted);
}

Status Check(const LidarCamera& camera, const Image<Color>& color, const Image<std::uint32_t>& segments,
             const LidarData& scan) {
  constexpr int kMaxCameraSide_px = 16384;
  Status bad = InvalidArgument("the camera beside the LiDAR is not usable").WithReason("BAD_CAMERA");
  if (camera.width_px < 1 || camera.width_px > kMaxCameraSide_px || camera.height_px < 1 ||
      camera.height_px > kMaxCameraSide_px) {
    bad.AddViolation("camera", "width_px or height_px is not within 1 and 16384");
  }
  if (!camera.P_image_lidar.allFinite()) bad.AddViolation("camera.P_image_lidar", "is not finite");
  const std::size_t n = scan.points_m.size();
  if (!scan.color.empty() && scan.color.size() != n) bad.AddViolation("scan.color", "is not one a point");
  if (!scan.segments.empty() && scan.segments.size() != n) bad.AddViolation("scan.segments", "is not one a point");
  if (!scan.is_hidden.empty() && scan.is_hidden.size() != n) bad.AddViolation("scan.is_hidden", "is not one a point");
  if (!bad.violations().empty()) return bad;
  DHPMAP_RETURN_IF_ERROR(CheckSize(camera, color, "color"));
  return CheckSize(camera, segments, "segments");
}

/// Bilinear at (u, v), which lies between pixel centres of the image.
Color Sample(const Image<Color>& image, double u, double v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const int u1 = std::min(u0 + 1, image.width_px - 1), v1 = std::min(v0 + 1, image.height_px - 1);
  const double fu = u - u0, fv = v - v0;
  const auto at = [&image](int x, int y) { return image.pixels[static_cast<std::size_t>(y) * image.width_px + x]; };
  const Color c00 = at(u0, v0), c10 = at(u1, v0), c01 = at(u0, v1), c11 = at(u1, v1);
  const auto mix = [fu, fv](std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
    return static_cast<std::uint8_t>((a * (1 - fu) + b * fu) * (1 - fv) + (c * (1 - fu) + d * fu) * fv + 0.5);
  };
  return {mix(c00.r, c10.r, c01.r, c11.r), mix(c00.g, c10.g, c01.g, c11.g), mix(c00.b, c10.b, c01.b, c11.b)};
}

/// Beyond it all is as far.
constexpr double kFarthest_m = 1e9;

/// Whatever the scan has of a point goes to an earlier place.
void MovePoint(std::size_t from, std::size_t to, LidarData& scan) {
  scan.points_m[to] = scan.points_m[from];
  if (!scan.color.empty()) scan.color[to] = scan.color[from];
  if (!scan.segments.empty()) scan.segments[to] = scan.segments[from];
  if (!scan.is_hidden.empty()) scan.is_hidden[to] = scan.is_hidden[from];
}

void Truncate(std::size_t num_points, LidarData& scan) {
  scan.points_m.resize(num_points);
  if (!scan.color.empty()) scan.color.resize(num_points);
  if (!scan.segments.empty()) scan.segments.resize(num_points);
  if (!scan.is_hidden.empty()) scan.is_hidden.resize(num_points);
}

}  // namespace

Status ProjectImagesOntoScan(const LidarCamera& camera, const Image<Color>& color, const Image<std::uint32_t>& segments,
                             LidarData& scan) {
  DHPMAP_RETURN_IF_ERROR(Check(camera, color, segments, scan));
  const bool has_color = color.width_px > 0, has_segments = segments.width_px > 0;
  const std::size_t num_points = scan.points_m.size();
  if (has_color) scan.color.resize(num_points);
  if (has_segments) scan.segments.resize(num_points);
  if (has_segments) scan.is_hidden.clear();

  // P may have any scale: the third row of K * R is a unit vector.
  const double scale = camera.P_image_lidar.row(2).head<3>().stableNorm();
  const double metres = scale > 0 ? 1 / scale : 0;
  std::size_t kept = 0;
  std::vector<ProjectedPoint> labelled;
  if (has_segments) labelled.reserve(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    const Eigen::Vector3d q = camera.P_image_lidar * scan.points_m[i].cast<double>().homogeneous();
    if (!(q.z() > 0)) continue;
    const double u = q.x() / q.z(), v = q.y() / q.z();
    // All four neighbours lie in the image; written so that NaN fails.
    if (!(u >= 0 && v >= 0 && std::ceil(u) < camera.width_px && std::ceil(v) < camera.height_px)) continue;
    MovePoint(i, kept, scan);
    if (has_color) scan.color[kept] = Sample(color, u, v);
    if (has_segments) {
      scan.segments[kept] =
          segments.pixels[static_cast<std::size_t>(v) * segments.width_px + static_cast<std::size_t>(u)];
      labelled.push_back(
          {static_cast<float>(u), static_cast<float>(v), static_cast<float>(std::min(q.z() * metres, kFarthest_m))});
    }
    ++kept;
  }
  Truncate(kept, scan);
  if (has_segments) scan.is_hidden = FindHiddenPoints(labelled, camera.width_px, camera.height_px);
  return Status::Ok();
}

}  // namespace dhpmap
