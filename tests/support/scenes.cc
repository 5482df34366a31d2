// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scenes.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dhpmap::testing {
namespace {

constexpr double kMaxRange_m = 20.0;
constexpr double kHitTolerance_m = 1e-5;

/// Sphere tracing: distance along the unit ray, or 0 if nothing is hit.
double Trace(const Scene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double t = 0;
  while (t < kMaxRange_m) {
    const double distance = scene.Distance(origin + t * direction);
    if (distance < kHitTolerance_m) return t;
    t += distance;
  }
  return 0;
}

}  // namespace

double Solid::Distance(const Eigen::Vector3d& p) const {
  switch (shape) {
    case Shape::kSphere: return (p - center_m).norm() - size_m.x();
    case Shape::kHalfSpace: return (p - center_m).dot(size_m.normalized());
    case Shape::kBox: {
      const Eigen::Vector3d q = (p - center_m).cwiseAbs() - size_m;
      return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
    }
  }
  return std::numeric_limits<double>::infinity();
}

double Scene::Distance(const Eigen::Vector3d& p) const {
  double distance = std::numeric_limits<double>::infinity();
  for (const Solid& solid : solids) distance = std::min(distance, solid.Distance(p));
  return distance;
}

const Solid* Scene::Nearest(const Eigen::Vector3d& p) const {
  const auto it = std::min_element(solids.begin(), solids.end(),
                                   [&p](const Solid& a, const Solid& b) { return a.Distance(p) < b.Distance(p); });
  return it == solids.end() ? nullptr : &*it;
}

PinholeCamera SmallCamera() { return {160, 120, 80.0, 80.0, 80.0, 60.0}; }

Transform LookAt(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m) {
  const Eigen::Vector3d forward = (target_m - eye_m).normalized();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (right.norm() < 1e-9) right = Eigen::Vector3d::UnitX();
  right.normalize();
  Transform T = Transform::Identity();
  T.linear().col(0) = right;
  T.linear().col(1) = forward.cross(right);
  T.linear().col(2) = forward;
  T.translation() = eye_m;
  return T;
}

PanopticFrame Render(const Scene& scene, const PinholeCamera& camera, const Transform& T_map_camera) {
  PanopticFrame frame;
  frame.T_map_sensor = T_map_camera;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = camera;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1.0);
      const Eigen::Vector3d direction = T_map_camera.linear() * ray.normalized();
      const double range = Trace(scene, T_map_camera.translation(), direction);
      const Solid* solid = range > 0 ? scene.Nearest(T_map_camera.translation() + range * direction) : nullptr;
      data.depth_m.push_back(static_cast<float>(range / ray.norm()));
      data.color.push_back(solid ? solid->color : Color{});
      data.segments.push_back(solid ? solid->segment : 0);
    }
  }
  return frame;
}

std::shared_ptr<const LabelSet> MakeLabelSet(int num_things, int num_stuff) {
  std::vector<LabelClass> classes;
  for (int i = 1; i <= num_things + num_stuff; ++i) {
    const bool is_thing = i <= num_things;
    classes.push_back({.id = ClassId(static_cast<std::uint16_t>(i)),
                       .name = (is_thing ? "thing" : "stuff") + std::to_string(i),
                       .panoptic = is_thing ? Panoptic::kThing : Panoptic::kStuff});
  }
  return std::make_shared<LabelSet>(LabelSet::Create(std::move(classes)).value());
}

TempDir::TempDir() {
  std::string name = (std::filesystem::temp_directory_path() / "dhpmap-test-XXXXXX").string();
  path_ = mkdtemp(name.data());
}

TempDir::~TempDir() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path SharedDataDir() {
  const std::filesystem::path path = std::filesystem::path(DHPMAP_SHARED_DATA_DIR);
  return std::filesystem::is_directory(path) ? path : std::filesystem::path();
}

}  // namespace dhpmap::testing
