// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

namespace dhpmap::simulator {

/// Intersections of rays this far from the origin have errors below 1e-5 m.
inline constexpr double kFar_m = 100.0;

/// The direction has unit length.
struct Ray {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d direction;
  [[nodiscard]] Eigen::Vector3d At(double t_m) const { return origin_m + t_m * direction; }
};

/// A part of a piece of furniture with exact distances and intersections, convex except the torus. In its own frame it
/// is centred at the origin, with z as its axis. Immutable once its bounds are computed.
struct Solid {
  enum class Shape : std::uint8_t { kBox, kSphere, kCylinder, kCapsule, kCone, kTorus };
  Shape shape = Shape::kBox;
  std::uint8_t instance = 0;    ///< index into the scene's instances
  std::uint16_t material = 0;   ///< index into the scene's materials
  std::uint16_t look_seed = 0;  ///< varies the look of solids of one material (planks, books)
  /// Box: half extents including rounding. Cylinder, cone: half height in z. Capsule: half of the inner segment in z.
  /// Cone: lower radius in x, upper radius in y. Torus: radius of the ring in x.
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  /// Sphere, cylinder, capsule: radius. Torus: radius of the tube. Box: rounding of edges, 0: sharp.
  double radius_m = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_map_solid = Eigen::Matrix3d::Identity();

  [[nodiscard]] Eigen::Vector3d ToLocal(const Eigen::Vector3d& p) const {
    return R_map_solid.transpose() * (p - center_m);
  }
  /// Signed distance, m, negative inside, exact on both sides.
  [[nodiscard]] double Distance(const Eigen::Vector3d& p) const { return LocalDistance(ToLocal(p)); }
  /// Outward unit normal at a point on or near the surface.
  [[nodiscard]] Eigen::Vector3d Normal(const Eigen::Vector3d& p) const;
  /// The distance at which the ray enters within (0, max_m); nothing for rays that start inside.
  [[nodiscard]] std::optional<double> Intersect(const Ray& ray, double max_m) const;
  /// In the map frame.
  [[nodiscard]] Eigen::AlignedBox3d Bounds() const;
  /// Half extents of the bounding box in the solid's own frame.
  [[nodiscard]] Eigen::Vector3d LocalExtents() const;

 private:
  [[nodiscard]] double LocalDistance(const Eigen::Vector3d& p) const;
  [[nodiscard]] Eigen::Vector3d LocalNormal(const Eigen::Vector3d& p) const;  ///< not normalised
  [[nodiscard]] bool IsOnFlatFace(const Eigen::Vector3d& p) const;
  /// The distance in (from_m, to_m) at which a local ray enters; it must be outside at from_m.
  [[nodiscard]] std::optional<double> Approach(const Ray& ray, double from_m, double to_m) const;
};

}  // namespace dhpmap::simulator
