// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dhpmap {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Row kNoRow{kInfinity, -kInfinity};

/// The union of two ranges that touch, or one of which is empty.
Row Both(const Row& a, const Row& b) { return {std::min(a.first_m, b.first_m), std::max(a.last_m, b.last_m)}; }

Row RowInBall(const Eigen::Vector3d& center_m, double radius_m, double y_m, double z_m) {
  const double dy = y_m - center_m.y(), dz = z_m - center_m.z();
  const double rest = radius_m * radius_m - dy * dy - dz * dz;
  if (rest < 0) return kNoRow;
  const double half_m = std::sqrt(rest);
  return {center_m.x() - half_m, center_m.x() + half_m};
}

/// The range in which low <= start + x * slope <= high.
Row Between(double start, double slope, double low, double high) {
  constexpr double kParallel = 1e-12;
  if (std::abs(slope) < kParallel) return start >= low && start <= high ? Row{-kInfinity, kInfinity} : kNoRow;
  const double a = (low - start) / slope, b = (high - start) / slope;
  return {std::min(a, b), std::max(a, b)};
}

Row Common(const Row& a, const Row& b) { return {std::max(a.first_m, b.first_m), std::min(a.last_m, b.last_m)}; }

/// Inside the capsule without its spherical ends.
Row RowInCylinder(const Capsule& capsule, double y_m, double z_m) {
  const Eigen::Vector3d axis = capsule.b_m - capsule.a_m;
  const double length_m = axis.norm();
  if (!(length_m > 0)) return kNoRow;
  const Eigen::Vector3d u = axis / length_m;
  const Eigen::Vector3d from_a = Eigen::Vector3d(0, y_m, z_m) - capsule.a_m;
  const double along = from_a.dot(u);
  const Eigen::Vector3d start = from_a - along * u, step = Eigen::Vector3d::UnitX() - u.x() * u;
  const Row between = Between(along, u.x(), 0, length_m);
  const double a = step.squaredNorm(), b = start.dot(step);
  const double c = start.squaredNorm() - capsule.radius_m * capsule.radius_m;
  constexpr double kParallel = 1e-18;
  if (a < kParallel) return c <= 0 ? between : kNoRow;
  const double rest = b * b - a * c;
  if (rest < 0) return kNoRow;
  const double half = std::sqrt(rest) / a;
  const Row row = Common(between, {-b / a - half, -b / a + half});
  return row.first_m <= row.last_m ? row : kNoRow;
}

}  // namespace

Eigen::AlignedBox3d BoundsOf(const Capsule& capsule) {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(capsule.radius_m);
  return {capsule.a_m.cwiseMin(capsule.b_m) - reach, capsule.a_m.cwiseMax(capsule.b_m) + reach};
}

Eigen::AlignedBox3d BoundsOf(const OrientedBox& box) {
  const Eigen::Vector3d reach = box.T_world_box.linear().cwiseAbs() * box.half_m;
  return {box.T_world_box.translation() - reach, box.T_world_box.translation() + reach};
}

Eigen::Vector3d CentreOf(const Capsule& capsule) { return 0.5 * (capsule.a_m + capsule.b_m); }

Eigen::Vector3d CentreOf(const OrientedBox& box) { return box.T_world_box.translation(); }

Capsule Moved(const Transform& T_there_here, const Capsule& capsule) {
  return {T_there_here * capsule.a_m, T_there_here * capsule.b_m, capsule.radius_m};
}

OrientedBox Moved(const Transform& T_there_here, const OrientedBox& box) {
  return {T_there_here * box.T_world_box, box.half_m};
}

Capsule Shifted(const Capsule& capsule, const Eigen::Vector3d& by_m) {
  return {capsule.a_m + by_m, capsule.b_m + by_m, capsule.radius_m};
}

OrientedBox Shifted(const OrientedBox& box, const Eigen::Vector3d& by_m) {
  OrientedBox shifted = box;
  shifted.T_world_box.translation() += by_m;
  return shifted;
}

Capsule AtLeast(double half_m, const Capsule& capsule) {
  return {capsule.a_m, capsule.b_m, std::max(capsule.radius_m, half_m)};
}

OrientedBox AtLeast(double half_m, const OrientedBox& box) { return {box.T_world_box, box.half_m.cwiseMax(half_m)}; }

Row RowIn(const Capsule& capsule, double y_m, double z_m) {
  const Row ball = RowInBall(capsule.a_m, capsule.radius_m, y_m, z_m);
  if (capsule.a_m == capsule.b_m) return ball;
  return Both(Both(ball, RowInBall(capsule.b_m, capsule.radius_m, y_m, z_m)), RowInCylinder(capsule, y_m, z_m));
}

Row RowIn(const OrientedBox& box, double y_m, double z_m) {
  const Eigen::Matrix3d to_box = box.T_world_box.linear().transpose();
  const Eigen::Vector3d start = to_box * (Eigen::Vector3d(0, y_m, z_m) - box.T_world_box.translation());
  Row row{-kInfinity, kInfinity};
  for (int axis = 0; axis < 3; ++axis) {
    row = Common(row, Between(start[axis], to_box(axis, 0), -box.half_m[axis], box.half_m[axis]));
  }
  return row;
}

}  // namespace dhpmap
