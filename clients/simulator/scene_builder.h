// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "clients/simulator/material.h"
#include "clients/simulator/object_class.h"
#include "clients/simulator/solid.h"

namespace dhpmap::simulator {

struct Instance {
  std::uint8_t id = 0;  ///< pixel value in the ground truth
  ObjectClass object_class = ObjectClass::kUnknown;
  std::string name;  ///< class and running number: "chair_003"
};

/// The place of a piece of furniture: its origin is on the floor below its centre, and its front faces its own +y.
struct Place {
  double x_m = 0, y_m = 0, z_m = 0;
  double yaw_deg = 0;  ///< counter-clockwise seen from above
};

/// Builds a scene from solids. Solids are given in the frame of the current instance.
class SceneBuilder {
 public:
  SceneBuilder();

  /// The following solids belong to a new thing of this class.
  void BeginThing(ObjectClass object_class, const Place& place);
  /// The following solids belong to the single instance of this stuff class.
  void BeginStuff(ObjectClass object_class, const Place& place = {});
  /// Rotates the following solids about z (then y, then x; degrees) at their own centre; {}: no rotation.
  void Turn(const Eigen::Vector3d& zyx_deg) { turn_deg_ = zyx_deg; }

  using Vector3d = Eigen::Vector3d;
  void Box(const Vector3d& center_m, const Vector3d& full_size_m, const Material& material, double rounding_m = 0);
  void Sphere(const Vector3d& center_m, double radius_m, const Material& material);
  /// Upright unless rotated.
  void Cylinder(const Vector3d& center_m, double radius_m, double height_m, const Material& material);
  void Cone(const Vector3d& center_m, double radius_below_m, double radius_above_m, double height_m,
            const Material& material);
  void Torus(const Vector3d& center_m, double ring_radius_m, double tube_radius_m, const Material& material);
  void Capsule(const Vector3d& from_m, const Vector3d& to_m, double radius_m, const Material& material);

  [[nodiscard]] const std::vector<Instance>& instances() const { return instances_; }  ///< by id, 0: nothing
  [[nodiscard]] const std::vector<Material>& materials() const { return materials_; }
  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }

 private:
  void Begin(const Place& place);
  std::uint8_t AddInstance(ObjectClass object_class);
  void Add(Solid solid, const Vector3d& center_m, const Eigen::Matrix3d& R_thing_solid, const Material& material);
  [[nodiscard]] Eigen::Matrix3d Turned() const;

  std::vector<Instance> instances_;
  std::vector<Material> materials_;
  std::vector<Solid> solids_;
  std::uint8_t instance_ = 0;
  Vector3d origin_m_ = Vector3d::Zero();
  Eigen::Matrix3d R_map_thing_ = Eigen::Matrix3d::Identity();
  Vector3d turn_deg_ = Vector3d::Zero();
};

}  // namespace dhpmap::simulator
