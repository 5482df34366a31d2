// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/solid.h"

#include <algorithm>
#include <cmath>

namespace dhpmap::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kTouching_m = 1e-7;
constexpr int kMaxSteps = 1000;  // only tori at grazing incidence come near this

/// Without the overflow protection of std::hypot, which costs ten times as much.
double Length(double x, double y) { return std::sqrt(x * x + y * y); }

double BoxDistance(const Vector3d& p, const Vector3d& half) {
  const Vector3d q = p.cwiseAbs() - half;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

double CylinderDistance(const Vector3d& p, double radius, double half_height) {
  const double dr = Length(p.x(), p.y()) - radius;
  const double dz = std::abs(p.z()) - half_height;
  return std::min(std::max(dr, dz), 0.0) + Length(std::max(dr, 0.0), std::max(dz, 0.0));
}

double CapsuleDistance(const Vector3d& p, double radius, double half_length) {
  return Vector3d(p.x(), p.y(), p.z() - std::clamp(p.z(), -half_length, half_length)).norm() - radius;
}

/// Truncated cone: the nearer of cap and side, in the half plane (r, z).
double ConeDistance(const Vector3d& p, double below, double above, double h) {
  const Eigen::Vector2d q(Length(p.x(), p.y()), p.z());
  const Eigen::Vector2d cap(q.x() - std::min(q.x(), q.y() < 0 ? below : above), std::abs(q.y()) - h);
  const Eigen::Vector2d along(above - below, 2 * h);
  const Eigen::Vector2d from_below(q.x() - below, q.y() + h);
  const double s = std::clamp(from_below.dot(along) / along.squaredNorm(), 0.0, 1.0);
  const Eigen::Vector2d flank = from_below - s * along;
  const bool is_inside = flank.x() < 0 && cap.y() < 0;
  return (is_inside ? -1 : 1) * std::sqrt(std::min(cap.squaredNorm(), flank.squaredNorm()));
}

double TorusDistance(const Vector3d& p, double ring, double tube) {
  return Length(Length(p.x(), p.y()) - ring, p.z()) - tube;
}

/// The part of a ray inside a box around the origin.
struct Interval {
  double enter_m, leave_m;
  [[nodiscard]] bool is_empty() const { return !(enter_m <= leave_m); }
};

Interval BoxInterval(const Ray& ray, const Vector3d& half) {
  Interval interval{-2 * kFar_m, 2 * kFar_m};
  for (int i = 0; i < 3; ++i) {
    const double inverse = 1.0 / ray.direction[i];
    const double t0 = (-half[i] - ray.origin_m[i]) * inverse, t1 = (half[i] - ray.origin_m[i]) * inverse;
    // This order keeps the interval if a value is NaN (a ray in the plane of a face).
    interval.enter_m = std::max(interval.enter_m, std::min(t0, t1));
    interval.leave_m = std::min(interval.leave_m, std::max(t0, t1));
  }
  return interval;
}

/// The interval inside |projection onto `axes`| <= radius, around the point of closest approach, for precision.
Interval RoundInterval(const Ray& ray, const Vector3d& axes, double radius) {
  const Vector3d o = ray.origin_m.cwiseProduct(axes), d = ray.direction.cwiseProduct(axes);
  const double a = d.squaredNorm();
  if (a < 1e-14) {
    return o.squaredNorm() < radius * radius ? Interval{-2 * kFar_m, 2 * kFar_m} : Interval{1, -1};
  }
  const double closest = -o.dot(d) / a;
  const double left = radius * radius - (o + closest * d).squaredNorm();
  if (left < 0) return {1, -1};
  const double half = std::sqrt(left / a);
  return {closest - half, closest + half};
}

Interval Common(const Interval& a, const Interval& b) {
  return {std::max(a.enter_m, b.enter_m), std::min(a.leave_m, b.leave_m)};
}

/// A capsule is the union of a cylinder and two spheres, all convex: the ray enters at the first entry into one of
/// them.
Interval CapsuleInterval(const Ray& ray, double radius, double half_length) {
  Interval whole = Common(RoundInterval(ray, {1, 1, 0}, radius), BoxInterval(ray, {kFar_m, kFar_m, half_length}));
  for (double end : {-half_length, half_length}) {
    const Ray shifted{ray.origin_m - Vector3d(0, 0, end), ray.direction};
    const Interval ball = RoundInterval(shifted, {1, 1, 1}, radius);
    if (ball.is_empty()) continue;
    whole = whole.is_empty() ? ball
                             : Interval{std::min(whole.enter_m, ball.enter_m), std::max(whole.leave_m, ball.leave_m)};
  }
  return whole;
}

}  // namespace

double Solid::LocalDistance(const Vector3d& p) const {
  switch (shape) {
    case Shape::kBox: return BoxDistance(p, size_m.array() - radius_m) - radius_m;
    case Shape::kSphere: return p.norm() - radius_m;
    case Shape::kCylinder: return CylinderDistance(p, radius_m, size_m.z());
    case Shape::kCapsule: return CapsuleDistance(p, radius_m, size_m.z());
    case Shape::kCone: return ConeDistance(p, size_m.x(), size_m.y(), size_m.z());
    case Shape::kTorus: return TorusDistance(p, size_m.x(), radius_m);
  }
  return kFar_m;
}

Vector3d Solid::LocalNormal(const Vector3d& p) const {
  switch (shape) {
    case Shape::kSphere: return p;
    case Shape::kCapsule: return {p.x(), p.y(), p.z() - std::clamp(p.z(), -size_m.z(), size_m.z())};
    case Shape::kTorus: {
      const double outward = 1 - size_m.x() / std::max(Length(p.x(), p.y()), 1e-9);
      return {p.x() * outward, p.y() * outward, p.z()};
    }
    case Shape::kCylinder:
      if (std::abs(p.z()) - size_m.z() > Length(p.x(), p.y()) - radius_m) return {0, 0, p.z()};
      return {p.x(), p.y(), 0};
    case Shape::kCone: {
      const double slope = (size_m.x() - size_m.y()) / (2 * size_m.z());
      const double r = Length(p.x(), p.y());
      const double to_flank = (r - (size_m.x() + size_m.y()) / 2 + slope * p.z()) / Length(1, slope);
      if (std::abs(p.z()) - size_m.z() > to_flank) return {0, 0, p.z()};
      return {p.x(), p.y(), slope * r};
    }
    case Shape::kBox: break;
  }
  const Vector3d beyond = p.cwiseAbs() - size_m + Vector3d::Constant(radius_m);
  int axis = 0;
  if (beyond.maxCoeff(&axis) <= 0 || radius_m == 0) return p[axis] * Vector3d::Unit(axis);
  return beyond.cwiseMax(0.0).cwiseProduct(p.cwiseSign());
}

Vector3d Solid::Normal(const Vector3d& p) const { return (R_map_solid * LocalNormal(ToLocal(p))).normalized(); }

std::optional<double> Solid::Intersect(const Ray& ray_map, double max_m) const {
  const Ray ray{ToLocal(ray_map.origin_m), R_map_solid.transpose() * ray_map.direction};
  Interval inside{1, -1};
  bool is_exact = true;
  switch (shape) {
    case Shape::kSphere: inside = RoundInterval(ray, {1, 1, 1}, radius_m); break;
    case Shape::kCylinder:
      inside = Common(RoundInterval(ray, {1, 1, 0}, radius_m), BoxInterval(ray, {kFar_m, kFar_m, size_m.z()}));
      break;
    case Shape::kCapsule: inside = CapsuleInterval(ray, radius_m, size_m.z()); break;
    case Shape::kBox:
      inside = BoxInterval(ray, size_m);
      is_exact = radius_m == 0;
      break;
    case Shape::kCone:
    case Shape::kTorus:
      inside = BoxInterval(ray, LocalExtents());
      is_exact = false;
      break;
  }
  if (inside.is_empty() || inside.leave_m <= 0 || inside.enter_m >= max_m) return std::nullopt;
  if (is_exact) return inside.enter_m > 0 ? std::optional(inside.enter_m) : std::nullopt;

  const double start_m = std::max(inside.enter_m, 0.0);
  if (shape == Shape::kBox && inside.enter_m > 0 && IsOnFlatFace(ray.At(start_m))) return start_m;
  const std::optional<double> t = Approach(ray, start_m, inside.leave_m);
  return t && *t > 0 && *t < max_m ? t : std::nullopt;
}

/// Whether a point on the sharp box's surface is also on the rounded one.
bool Solid::IsOnFlatFace(const Vector3d& p) const { return ((p.cwiseAbs() - size_m).array() > -radius_m).count() <= 1; }

// The distance is exact, so a step of its length never overshoots. Along a line it is convex (except for the torus), so
// secant steps do not overshoot either, and once it stops decreasing it never decreases again.
std::optional<double> Solid::Approach(const Ray& ray, double from_m, double to_m) const {
  const bool is_convex = shape != Shape::kTorus;
  double t = from_m, distance = LocalDistance(ray.At(t));
  if (distance <= 0) return distance > -kTouching_m ? std::optional(t) : std::nullopt;
  double step = distance;
  for (int i = 0; i < kMaxSteps && distance >= kTouching_m; ++i) {
    t += step;
    if (t > to_m) return std::nullopt;
    const double nearer = LocalDistance(ray.At(t)), slope = (nearer - distance) / step;
    distance = nearer;
    if (is_convex && slope >= 0 && distance >= kTouching_m) return std::nullopt;
    step = is_convex ? std::max(distance, -distance / slope) : distance;
  }
  return distance < kTouching_m ? std::optional(t) : std::nullopt;
}

Vector3d Solid::LocalExtents() const {
  switch (shape) {
    case Shape::kBox: return size_m;
    case Shape::kSphere: return Vector3d::Constant(radius_m);
    case Shape::kCylinder: return {radius_m, radius_m, size_m.z()};
    case Shape::kCapsule: return {radius_m, radius_m, size_m.z() + radius_m};
    case Shape::kCone: {
      const double r = std::max(size_m.x(), size_m.y());
      return {r, r, size_m.z()};
    }
    case Shape::kTorus: return {size_m.x() + radius_m, size_m.x() + radius_m, radius_m};
  }
  return Vector3d::Zero();
}

Eigen::AlignedBox3d Solid::Bounds() const {
  const Vector3d half = R_map_solid.cwiseAbs() * LocalExtents();
  return {center_m - half, center_m + half};
}

}  // namespace dhpmap::simulator
