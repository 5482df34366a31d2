// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/scene_builder.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <numbers>

namespace dhpmap::simulator {
namespace {

[[maybe_unused]] constexpr std::size_t kMaxInstances = 255;  // because ids are 8-bit pixels

Eigen::Matrix3d About(const Eigen::Vector3d& axis, double angle_deg) {
  Eigen::Matrix3d R = Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180, axis).toRotationMatrix();
  // Make quarter turns exact, so that walls stay in their planes.
  for (double& entry : R.reshaped()) {
    if (std::abs(entry) < 1e-15) entry = 0;
  }
  return R;
}

}  // namespace

SceneBuilder::SceneBuilder() { instances_.push_back({0, ObjectClass::kUnknown, "unknown"}); }

void SceneBuilder::BeginThing(ObjectClass object_class, const Place& place) {
  Begin(place);
  instance_ = AddInstance(object_class);
}

void SceneBuilder::BeginStuff(ObjectClass object_class, const Place& place) {
  Begin(place);
  const auto it = std::find_if(instances_.begin(), instances_.end(),
                               [&](const Instance& instance) { return instance.object_class == object_class; });
  instance_ = it != instances_.end() ? it->id : AddInstance(object_class);
}

void SceneBuilder::Begin(const Place& place) {
  origin_m_ = {place.x_m, place.y_m, place.z_m};
  R_map_thing_ = About(Vector3d::UnitZ(), place.yaw_deg);
  turn_deg_.setZero();
}

std::uint8_t SceneBuilder::AddInstance(ObjectClass object_class) {
  assert(instances_.size() <= kMaxInstances);
  const auto number = 1 + std::count_if(instances_.begin(), instances_.end(), [&](const Instance& instance) {
                        return instance.object_class == object_class;
                      });
  char digits[24];
  std::snprintf(digits, sizeof(digits), "_%03d", static_cast<int>(number));
  const auto id = static_cast<std::uint8_t>(instances_.size());
  instances_.push_back({id, object_class, InfoOf(object_class).name + std::string(digits)});
  return id;
}

Eigen::Matrix3d SceneBuilder::Turned() const {
  return About(Vector3d::UnitZ(), turn_deg_[0]) * About(Vector3d::UnitY(), turn_deg_[1]) *
         About(Vector3d::UnitX(), turn_deg_[2]);
}

void SceneBuilder::Add(Solid solid, const Vector3d& center_m, const Eigen::Matrix3d& R_thing_solid,
                       const Material& material) {
  auto it = std::find(materials_.begin(), materials_.end(), material);
  if (it == materials_.end()) it = materials_.insert(it, material);
  solid.material = static_cast<std::uint16_t>(it - materials_.begin());
  solid.instance = instance_;
  solid.look_seed = static_cast<std::uint16_t>(solids_.size());
  solid.center_m = origin_m_ + R_map_thing_ * center_m;
  solid.R_map_solid = R_map_thing_ * R_thing_solid;
  solids_.push_back(solid);
}

void SceneBuilder::Box(const Vector3d& center_m, const Vector3d& full_size_m, const Material& material,
                       double rounding_m) {
  Solid solid;
  solid.size_m = full_size_m / 2;
  solid.radius_m = std::min(rounding_m, solid.size_m.minCoeff() * 0.999);
  Add(solid, center_m, Turned(), material);
}

void SceneBuilder::Sphere(const Vector3d& center_m, double radius_m, const Material& material) {
  Solid solid;
  solid.shape = Solid::Shape::kSphere;
  solid.radius_m = radius_m;
  Add(solid, center_m, Turned(), material);
}

void SceneBuilder::Cylinder(const Vector3d& center_m, double radius_m, double height_m, const Material& material) {
  Solid solid;
  solid.shape = Solid::Shape::kCylinder;
  solid.radius_m = radius_m;
  solid.size_m.z() = height_m / 2;
  Add(solid, center_m, Turned(), material);
}

void SceneBuilder::Cone(const Vector3d& center_m, double radius_below_m, double radius_above_m, double height_m,
                        const Material& material) {
  Solid solid;
  solid.shape = Solid::Shape::kCone;
  solid.size_m = {radius_below_m, radius_above_m, height_m / 2};
  Add(solid, center_m, Turned(), material);
}

void SceneBuilder::Torus(const Vector3d& center_m, double ring_radius_m, double tube_radius_m,
                         const Material& material) {
  Solid solid;
  solid.shape = Solid::Shape::kTorus;
  solid.size_m.x() = ring_radius_m;
  solid.radius_m = tube_radius_m;
  Add(solid, center_m, Turned(), material);
}

void SceneBuilder::Capsule(const Vector3d& from_m, const Vector3d& to_m, double radius_m, const Material& material) {
  Solid solid;
  solid.shape = Solid::Shape::kCapsule;
  solid.radius_m = radius_m;
  solid.size_m.z() = (to_m - from_m).norm() / 2;
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), to_m - from_m).toRotationMatrix();
  Add(solid, (from_m + to_m) / 2, R, material);
}

}  // namespace dhpmap::simulator
