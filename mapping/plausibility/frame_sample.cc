// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/frame_sample.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

/// At most some more than this many are looked at: shares of 250 are right within .03, and the check of a frame costs
/// a hundredth of fusing it.
constexpr std::size_t kNumLooks = 250;

bool IsReturn(float depth) { return std::isfinite(depth) && depth > 0; }

std::vector<Eigen::Vector3f> ReadCamera(const DepthCameraData& data) {
  const auto width = static_cast<std::size_t>(data.camera.width_px);
  const auto height = static_cast<std::size_t>(data.camera.height_px);
  const double pixels_a_look = static_cast<double>(width * height) / static_cast<double>(kNumLooks);
  const auto step = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(pixels_a_look)));
  std::vector<Eigen::Vector3f> readings;
  readings.reserve((width / step + 1) * (height / step + 1));
  for (std::size_t v = step / 2; v < height; v += step) {
    for (std::size_t u = step / 2; u < width; u += step) {
      const float depth = data.depth_m[v * width + u];
      if (IsReturn(depth)) readings.emplace_back(static_cast<float>(u), static_cast<float>(v), depth);
    }
  }
  return readings;
}

std::vector<Eigen::Vector3f> ReadLidar(const LidarData& data) {
  const std::size_t step = std::max<std::size_t>(1, data.points_m.size() / kNumLooks);
  std::vector<Eigen::Vector3f> readings;
  readings.reserve(data.points_m.size() / step + 1);
  for (std::size_t i = step / 2; i < data.points_m.size(); i += step) {
    if (data.points_m[i].squaredNorm() > 0) readings.push_back(data.points_m[i]);
  }
  return readings;
}

}  // namespace

FrameSample::FrameSample(const PanopticFrame& frame)
    : readings_(frame.camera ? ReadCamera(*frame.camera) : ReadLidar(*frame.lidar)) {}

std::vector<Eigen::Vector3f> FrameSample::PointsInRange(const SensorClaim& claim,
                                                        const IntegrationConfig& config) const {
  const auto scale = static_cast<float>(claim.metres_per_unit);
  const auto least_m = static_cast<float>(config.min_range_m), most_m = static_cast<float>(config.max_range_m);
  std::vector<Eigen::Vector3f> points_m;
  points_m.reserve(readings_.size());
  for (const Eigen::Vector3f& reading : readings_) {
    Eigen::Vector3f p_m = reading * scale;
    if (claim.camera) {
      const PinholeCamera& camera = *claim.camera;
      const float x = (reading.x() - static_cast<float>(camera.cx_px)) / static_cast<float>(camera.fx_px);
      const float y = (reading.y() - static_cast<float>(camera.cy_px)) / static_cast<float>(camera.fy_px);
      p_m = reading.z() * scale * Eigen::Vector3f(x, y, 1);
    }
    const float range_m = p_m.norm();
    if (range_m >= least_m && range_m <= most_m) points_m.push_back(p_m);
  }
  return points_m;
}

}  // namespace dhpmap
