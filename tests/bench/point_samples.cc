// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/point_samples.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

namespace dhpmap {
namespace {

bool IsNearOtherPixel(const DepthCameraData& data, int u, int v, int edge_px) {
  const int width = data.camera.width_px;
  const std::uint32_t own = data.segments[static_cast<std::size_t>(v * width + u)];
  for (int y = std::max(0, v - edge_px); y <= std::min(data.camera.height_px - 1, v + edge_px); ++y) {
    for (int x = std::max(0, u - edge_px); x <= std::min(width - 1, u + edge_px); ++x) {
      if (data.segments[static_cast<std::size_t>(y * width + x)] != own) return true;
    }
  }
  return false;
}

void SampleCamera(const PanopticFrame& frame, const SampleOptions& options, std::vector<PointSample>& samples) {
  const DepthCameraData& data = *frame.camera;
  const PinholeCamera& camera = data.camera;
  for (int v = 0; v < camera.height_px; v += options.step) {
    for (int u = 0; u < camera.width_px; u += options.step) {
      const auto pixel = static_cast<std::size_t>(v * camera.width_px + u);
      const double depth_m = data.depth_m[pixel];
      if (data.segments[pixel] == 0 || !(depth_m >= options.min_depth_m && depth_m <= options.max_depth_m)) continue;
      const Eigen::Vector3d p_camera((u - camera.cx_px) / camera.fx_px * depth_m,
                                     (v - camera.cy_px) / camera.fy_px * depth_m, depth_m);
      samples.push_back({(frame.T_map_sensor * p_camera).cast<float>(), data.segments[pixel],
                         IsNearOtherPixel(data, u, v, options.edge_px), static_cast<float>(p_camera.norm())});
    }
  }
}

/// Which objects have points in which cell of a coarse grid.
class ObjectGrid {
 public:
  ObjectGrid(const LidarData& scan, double cell_m) : cell_m_(cell_m) {
    for (std::size_t i = 0; i < scan.points_m.size(); ++i)
      objects_[KeyOf(CellOf(scan.points_m[i]))].insert(scan.segments[i]);
  }
  [[nodiscard]] bool HasOtherNear(const Eigen::Vector3f& point_m, std::uint32_t own) const {
    const Eigen::Vector3i center = CellOf(point_m);
    for (int i = 0; i < 27; ++i) {
      const auto it = objects_.find(KeyOf(center + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (it != objects_.end() && (it->second.size() > 1 || *it->second.begin() != own)) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] Eigen::Vector3i CellOf(const Eigen::Vector3f& p) const {
    return Eigen::Vector3i(static_cast<int>(std::floor(p.x() / cell_m_)), static_cast<int>(std::floor(p.y() / cell_m_)),
                           static_cast<int>(std::floor(p.z() / cell_m_)));
  }
  static std::int64_t KeyOf(const Eigen::Vector3i& cell) {
    return (static_cast<std::int64_t>(cell.x() & 0x1fffff) << 42) |
           (static_cast<std::int64_t>(cell.y() & 0x1fffff) << 21) | (cell.z() & 0x1fffff);
  }
  double cell_m_;
  std::unordered_map<std::int64_t, std::set<std::uint32_t>> objects_;
};

void SampleScan(const PanopticFrame& frame, const SampleOptions& options, std::vector<PointSample>& samples) {
  const LidarData& scan = *frame.lidar;
  const ObjectGrid grid(scan, options.edge_m);
  for (std::size_t i = 0; i < scan.points_m.size(); i += static_cast<std::size_t>(options.step)) {
    const double range_m = scan.points_m[i].norm();
    if (scan.segments[i] == 0 || !(range_m >= options.min_depth_m && range_m <= options.max_depth_m)) continue;
    samples.push_back({(frame.T_map_sensor * scan.points_m[i].cast<double>()).cast<float>(), scan.segments[i],
                       grid.HasOtherNear(scan.points_m[i], scan.segments[i]), static_cast<float>(range_m)});
  }
}

}  // namespace

std::vector<PointSample> SamplePoints(const PanopticFrame& frame, const SampleOptions& options) {
  std::vector<PointSample> samples;
  if (frame.camera && !frame.camera->segments.empty()) SampleCamera(frame, options, samples);
  if (frame.lidar && !frame.lidar->segments.empty()) SampleScan(frame, options, samples);
  return samples;
}

}  // namespace dhpmap
