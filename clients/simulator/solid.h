// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

namespace dhpmap::simulator {

/// Lines up to this far from the origin meet solids with errors below 1e-5 m.
inline constexpr double kFar_m = 100.0;

/// A half line; the direction has unit length.
struct Ray {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d direction;
  [[nodiscard]] Eigen::Vector3d At(double t_m) const { return origin_m + t_m * direction; }
};

/// A convex (but for the torus) piece of furniture with exact distance and exact intersection. In its own frame it is
/// centred on the origin, with z as axis. Immutable once its bounds are known.
struct Solid {
  enum class Shape : std::uint8_t { kBox, kSphere, kCylinder, kCapsule, kCone, kTorus };
  Shape shape = Shape::kBox;
  std::uint8_t instance = 0;    ///< index into the scene's instances
  std::uint16_t material = 0;   ///< index into the scene's materials
  std::uint16_t look_seed = 0;  ///< tells solids of one material apart (planks, books)
  /// Box: half extents with rounding. Cylinder, cone: half height in z. Capsule: half of the inner segment in z.
  /// Cone: radius below in x, above in y. Torus: radius of the ring in x.
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  /// Sphere, cylinder, capsule: radius. Torus: radius of the tube. Box: rounding of edges, 0 = sharp.
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
  /// Where the ray enters within (0, max_m); rays that start inside find nothing.
  [[nodiscard]] std::optional<double> Intersect(const Ray& ray, double max_m) const;
  /// In the map frame.
  [[nodiscard]] Eigen::AlignedBox3d Bounds() const;
  /// Half extents of the bounding box in the solid's own frame.
  [[nodiscard]] Eigen::Vector3d LocalExtents() const;

 private:
  [[nodiscard]] double LocalDistance(const Eigen::Vector3d& p) const;
  [[nodiscard]] Eigen::Vector3d LocalNormal(const Eigen::Vector3d& p) const;  ///< of any length
  [[nodiscard]] bool IsOnFlatFace(const Eigen::Vector3d& p) const;
  /// Where a local ray that is outside at from_m gets in before to_m.
  [[nodiscard]] std::optional<double> Approach(const Ray& ray, double from_m, double to_m) const;
};

}  // namespace dhpmap::simulator
