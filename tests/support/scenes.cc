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
constexpr double kNever = std::numeric_limits<double>::infinity();

// In plain numbers: the sanitizers' builds render thousands of frames with few optimisations.

double HitSphere(const Solid& ball, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double along = 0, distance2 = 0;
  for (int i = 0; i < 3; ++i) {
    const double to_center = ball.center_m[i] - origin[i];
    along += to_center * direction[i];
    distance2 += to_center * to_center;
  }
  const double half_chord2 = ball.size_m[0] * ball.size_m[0] - (distance2 - along * along);
  return along > 0 && half_chord2 >= 0 ? along - std::sqrt(half_chord2) : kNever;
}

double HitHalfSpace(const Solid& half, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double height = 0, rate = 0;  // both times the length of the normal
  for (int i = 0; i < 3; ++i) {
    height += (origin[i] - half.center_m[i]) * half.size_m[i];
    rate += direction[i] * half.size_m[i];
  }
  return rate < 0 ? -height / rate : kNever;
}

double HitBox(const Solid& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double enters = 0, leaves = kNever;
  for (int i = 0; i < 3; ++i) {
    const double to_center = box.center_m[i] - origin[i];
    if (direction[i] == 0) {
      if (std::abs(to_center) > box.size_m[i]) return kNever;
      continue;
    }
    const double middle = to_center / direction[i], half = box.size_m[i] / std::abs(direction[i]);
    enters = std::max(enters, middle - half);
    leaves = std::min(leaves, middle + half);
  }
  return enters <= leaves ? enters : kNever;
}

/// Distance from outside of a solid along the unit ray.
double Hit(const Solid& solid, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  switch (solid.shape) {
    case Solid::Shape::kSphere: return HitSphere(solid, origin, direction);
    case Solid::Shape::kHalfSpace: return HitHalfSpace(solid, origin, direction);
    case Solid::Shape::kBox: return HitBox(solid, origin, direction);
  }
  return kNever;
}

/// Distance from outside of all along the unit ray, or 0 if nothing is hit.
double Trace(const Scene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double nearest = kNever;
  for (const Solid& solid : scene.solids) nearest = std::min(nearest, Hit(solid, origin, direction));
  return nearest < kMaxRange_m ? nearest : 0;
}

}  // namespace

double Solid::Distance(const Eigen::Vector3d& p) const {
  const double x = p[0] - center_m[0], y = p[1] - center_m[1], z = p[2] - center_m[2];
  switch (shape) {
    case Shape::kSphere: return std::sqrt(x * x + y * y + z * z) - size_m[0];
    case Shape::kHalfSpace: {
      const double length = std::sqrt(size_m[0] * size_m[0] + size_m[1] * size_m[1] + size_m[2] * size_m[2]);
      return (x * size_m[0] + y * size_m[1] + z * size_m[2]) / length;
    }
    case Shape::kBox: {
      const double dx = std::abs(x) - size_m[0], dy = std::abs(y) - size_m[1], dz = std::abs(z) - size_m[2];
      const double ox = std::max(dx, 0.0), oy = std::max(dy, 0.0), oz = std::max(dz, 0.0);
      return std::sqrt(ox * ox + oy * oy + oz * oz) + std::min(std::max({dx, dy, dz}), 0.0);
    }
  }
  return kNever;
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
  const bool is_outside = scene.Distance(T_map_camera.translation()) >= kHitTolerance_m;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1.0);
      const Eigen::Vector3d direction = T_map_camera.linear() * ray.normalized();
      const double range = !is_outside ? 0 : Trace(scene, T_map_camera.translation(), direction);
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
