// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/surface_truth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace dhpmap::bench {
namespace {

constexpr double kCube_m = 0.1;
constexpr double kLeastDepth_m = 0.2;

using Corners = std::array<Eigen::Vector3d, 3>;
Corners CornersOf(const Mesh& mesh, std::uint32_t t) {
  const auto at = [&](std::size_t i) -> Eigen::Vector3d {
    return mesh.vertices_m[mesh.triangles[t][i]].cast<double>();
  };
  return {at(0), at(1), at(2)};
}

double SegmentDistance2(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
  return (a + t * along - p).squaredNorm();
}

/// The foot on the plane if that is within all three edges, else the nearest edge.
double Distance2(const Eigen::Vector3d& p, const Corners& t) {
  const Eigen::Vector3d across = (t[1] - t[0]).cross(t[2] - t[0]);
  bool is_within = across.squaredNorm() > 0;
  double nearest2 = SegmentDistance2(p, t[2], t[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = t[i], &b = t[(i + 1) % 3];
    is_within = is_within && (b - a).cross(p - a).dot(across) >= 0;
    nearest2 = std::min(nearest2, SegmentDistance2(p, a, b));
  }
  if (!is_within) return nearest2;
  const double height = (p - t[0]).dot(across);
  return height * height / across.squaredNorm();
}

BlockIndex CubeOf(const Eigen::Vector3d& p) {
  const VoxelIndex v = VoxelAt(p, kCube_m);
  return {v.x, v.y, v.z};
}

/// Of the cubes around one at a number of steps.
template <typename Visitor>
void VisitShell(const BlockIndex& centre, int steps, Visitor&& visit) {
  for (int z = -steps; z <= steps; ++z) {
    for (int y = -steps; y <= steps; ++y) {
      const bool is_face = std::abs(z) == steps || std::abs(y) == steps;
      for (int x = -steps; x <= steps; x += is_face || steps == 0 ? 1 : 2 * steps) {
        visit(BlockIndex{centre.x + x, centre.y + y, centre.z + z});
      }
    }
  }
}

}  // namespace

MeshTruth::MeshTruth(const Mesh& mesh) : mesh_(mesh) {
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners c = CornersOf(mesh, t);
    const BlockIndex low = CubeOf(c[0].cwiseMin(c[1]).cwiseMin(c[2]));
    const BlockIndex high = CubeOf(c[0].cwiseMax(c[1]).cwiseMax(c[2]));
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) cubes_[{x, y, z}].push_back(t);
      }
    }
    area += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    areas_.push_back(area);
  }
}

double MeshTruth::Distance(const Eigen::Vector3d& p, double limit_m) const {
  double nearest2 = limit_m * limit_m;
  const BlockIndex centre = CubeOf(p);
  // What lies in cubes at so many steps is farther than one step less.
  for (int steps = 0; steps == 0 || (steps - 1) * kCube_m < std::sqrt(nearest2); ++steps) {
    VisitShell(centre, steps, [&](const BlockIndex& cube) {
      const auto there = cubes_.find(cube);
      if (there == cubes_.end()) return;
      for (const std::uint32_t t : there->second) nearest2 = std::min(nearest2, Distance2(p, CornersOf(mesh_, t)));
    });
  }
  return std::sqrt(nearest2);
}

Eigen::Vector3d MeshTruth::Sample(std::mt19937& random) const {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto found = std::upper_bound(areas_.begin(), areas_.end(), unit(random) * areas_.back());
  const auto last = static_cast<std::ptrdiff_t>(areas_.size()) - 1;
  const Corners t =
      CornersOf(mesh_, static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(found - areas_.begin(), last)));
  const double root = std::sqrt(unit(random)), share = unit(random);
  return (1 - root) * t[0] + root * (1 - share) * t[1] + root * share * t[2];
}

DepthView LookAt(std::span<const PanopticFrame> frames, const Eigen::Vector3d& p, double near_m, double most_depth_m) {
  DepthView view;
  for (const PanopticFrame& frame : frames) {
    if (!frame.camera) continue;
    const PinholeCamera& camera = frame.camera->camera;
    const Eigen::Vector3d q = frame.T_map_sensor.inverse() * p;
    if (q.z() < kLeastDepth_m || q.z() > most_depth_m) continue;
    const double u = camera.fx_px * q.x() / q.z() + camera.cx_px, v = camera.fy_px * q.y() / q.z() + camera.cy_px;
    if (!(u > -0.5 && v > -0.5 && u < camera.width_px - 0.5 && v < camera.height_px - 0.5)) continue;
    const auto pixel = static_cast<std::size_t>(std::lround(v) * camera.width_px + std::lround(u));
    const double depth_m = static_cast<double>(frame.camera->depth_m[pixel]);
    if (!(depth_m > kLeastDepth_m)) continue;
    view.is_measured = view.is_measured || std::abs(depth_m - q.z()) <= near_m;
    view.is_looked_through = view.is_looked_through || depth_m - q.z() > near_m;
  }
  return view;
}

std::vector<Eigen::Vector3d> MeasuredPoints(std::span<const PanopticFrame> frames, std::size_t count,
                                            double most_depth_m, std::mt19937& random) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t tries = 0; points.size() < count && tries < 100 * count; ++tries) {
    const PanopticFrame& frame = frames[random() % frames.size()];
    if (!frame.camera) continue;
    const PinholeCamera& camera = frame.camera->camera;
    const auto width = static_cast<std::size_t>(camera.width_px);
    const std::size_t pixel = random() % frame.camera->depth_m.size();
    const double depth_m = static_cast<double>(frame.camera->depth_m[pixel]);
    if (!(depth_m > kLeastDepth_m && depth_m < most_depth_m)) continue;
    const double u = static_cast<double>(pixel % width), v = static_cast<double>(pixel / width);
    points.push_back(frame.T_map_sensor * Eigen::Vector3d((u - camera.cx_px) / camera.fx_px * depth_m,
                                                          (v - camera.cy_px) / camera.fy_px * depth_m, depth_m));
  }
  return points;
}

}  // namespace dhpmap::bench
