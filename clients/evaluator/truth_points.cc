// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/truth_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace dhpmap::evaluator {
namespace {

/// Class of a frame's segment ids; 0 for one without a class.
std::unordered_map<std::uint32_t, std::uint16_t> ClassesOfSegments(const PanopticFrame& frame) {
  std::unordered_map<std::uint32_t, std::uint16_t> classes;
  for (const SegmentInfo& segment : frame.segments) {
    classes[segment.id.value] = segment.class_id ? segment.class_id->value : std::uint16_t{0};
  }
  return classes;
}

}  // namespace

std::size_t TruthPoints::Hash::operator()(const Key& key) const {
  const std::size_t label = (std::size_t{key.instance} << 16) | key.class_id;
  return BlockIndexHash()({key.cell.x, key.cell.y, key.cell.z}) ^ (label * 0x9E3779B97F4A7C15u);
}

void TruthPoints::AddPoint(const Eigen::Vector3d& p_sensor, const Transform& T_map_sensor, std::uint16_t class_id,
                           std::uint32_t instance) {
  const double range_m = p_sensor.norm();
  if (!(range_m >= min_range_m_ && range_m <= max_range_m_)) return;
  const Eigen::Vector3d p = T_map_sensor * p_sensor;
  const VoxelIndex cell = VoxelAt(p, cell_m_);
  Sum& sum = sums_[{cell, instance, class_id}];
  ++sum.count;
  sum.from_corner_m += (p - cell_m_ * Eigen::Vector3d(cell.x, cell.y, cell.z)).cast<float>();
}

void TruthPoints::Add(const PanopticFrame& frame) {
  const auto classes = ClassesOfSegments(frame);
  const auto add = [&](const Eigen::Vector3d& p_sensor, std::uint32_t segment) {
    const auto known = classes.find(segment);
    const std::uint16_t class_id = known == classes.end() ? std::uint16_t{0} : known->second;
    AddPoint(p_sensor, frame.T_map_sensor, class_id, class_id == 0 ? 0 : segment);
  };
  if (frame.camera) {
    cell_m_ = kCameraCell_m;
    const PinholeCamera& camera = frame.camera->camera;
    for (int v = 0; v < camera.height_px; v += kStep_px) {
      for (int u = 0; u < camera.width_px; u += kStep_px) {
        const auto pixel =
            static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px) + static_cast<std::size_t>(u);
        const double depth_m = frame.camera->depth_m[pixel];
        if (!(depth_m > 0)) continue;
        add({(u - camera.cx_px) / camera.fx_px * depth_m, (v - camera.cy_px) / camera.fy_px * depth_m, depth_m},
            frame.camera->segments.empty() ? 0 : frame.camera->segments[pixel]);
      }
    }
    return;
  }
  cell_m_ = kScanCell_m;
  const LidarData& scan = *frame.lidar;
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    add(scan.points_m[i].cast<double>(), scan.segments.empty() ? 0 : scan.segments[i]);
  }
}

SurfaceSamples TruthPoints::Elements() const {
  std::vector<std::pair<Key, Sum>> all(sums_.begin(), sums_.end());
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    const auto order = [](const std::pair<Key, Sum>& x) {
      const Key& key = x.first;
      return std::make_tuple(key.cell.z, key.cell.y, key.cell.x, -std::int64_t{x.second.count}, key.class_id,
                             key.instance);
    };
    return order(a) < order(b);
  });
  SurfaceSamples elements;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [key, sum] = all[i];
    if (i > 0 && all[i - 1].first.cell == key.cell) continue;
    const Eigen::Vector3d corner_m = cell_m_ * Eigen::Vector3d(key.cell.x, key.cell.y, key.cell.z);
    elements.positions_m.emplace_back(
        (corner_m + sum.from_corner_m.cast<double>() / static_cast<double>(sum.count)).cast<float>());
    elements.classes.push_back(key.class_id);
    elements.instances.push_back(key.instance);
  }
  return elements;
}

}  // namespace dhpmap::evaluator
