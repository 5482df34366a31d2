// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/body_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dhpmap {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

Corners Exact(const TriangleCorners& t) { return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()}; }

Eigen::Vector3d UnitNormalOf(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]).stableNormalized(); }

void Improve(NearestPoints& best, const Eigen::Vector3d& on_segment, const Eigen::Vector3d& on_triangle) {
  const double distance2 = (on_segment - on_triangle).squaredNorm();
  if (distance2 < best.distance2) best = {on_segment, on_triangle, distance2, false};
}

/// Updates `best` with the nearest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
void ImproveBySegments(NearestPoints& best, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const Eigen::Vector3d u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  constexpr double kLeast = 1e-24;
  const double across = uu * vv - uv * uv;
  double s = across > 1e-12 * uu * vv ? std::clamp((uv * vw - uw * vv) / across, 0.0, 1.0) : 0;
  double t = vv > kLeast ? (uv * s + vw) / vv : 0;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = uu > kLeast ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0;
  }
  Improve(best, a + s * u, c + t * v);
}

/// The point where the segment crosses the triangle.
std::optional<Eigen::Vector3d> Crossing(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Corners& t,
                                        const Eigen::Vector3d& normal) {
  const double of_a = normal.dot(a - t[0]), of_b = normal.dot(b - t[0]);
  if ((of_a > 0) == (of_b > 0) || of_a == of_b) return std::nullopt;
  const Eigen::Vector3d p = a + of_a / (of_a - of_b) * (b - a);
  for (std::size_t i = 0; i < 3; ++i) {
    if ((t[(i + 1) % 3] - t[i]).cross(p - t[i]).dot(normal) < 0) return std::nullopt;
  }
  return p;
}

/// A point of the triangle inside the box, if there is one; both in the box's frame (Sutherland and Hodgman 1974).
std::optional<Eigen::Vector3d> PointInBox(const Corners& triangle, const Eigen::Vector3d& half) {
  std::array<Eigen::Vector3d, 10> polygon, clipped;
  std::copy(triangle.begin(), triangle.end(), polygon.begin());
  std::size_t count = 3;
  for (int side = 0; side < 6 && count > 0; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    const auto inside = [&](const Eigen::Vector3d& p) { return half[axis] - sign * p[axis]; };
    std::size_t num_clipped = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d &p = polygon[i], &next = polygon[(i + 1) % count];
      const double of_p = inside(p), of_next = inside(next);
      if (of_p >= 0) clipped[num_clipped++] = p;
      if ((of_p >= 0) != (of_next >= 0)) clipped[num_clipped++] = p + of_p / (of_p - of_next) * (next - p);
    }
    polygon = clipped;
    count = num_clipped;
  }
  if (count == 0) return std::nullopt;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += polygon[i];
  return sum / static_cast<double>(count);
}

/// The nearest points of a box and a triangle that do not intersect: from the corners and edges of each to the other.
NearestPoints NearestToBox(const Corners& triangle, const TriangleCorners& rounded, const Eigen::Vector3d& half) {
  NearestPoints best{{}, {}, std::numeric_limits<double>::infinity(), false};
  for (const Eigen::Vector3d& corner : triangle) Improve(best, corner.cwiseMax(-half).cwiseMin(half), corner);
  const auto corner_of = [&](unsigned bits) {
    return Eigen::Vector3d(bits & 1 ? half.x() : -half.x(), bits & 2 ? half.y() : -half.y(),
                           bits & 4 ? half.z() : -half.z());
  };
  for (unsigned bits = 0; bits < 8; ++bits) {
    const Eigen::Vector3d corner = corner_of(bits);
    Improve(best, corner, NearestPointOf(rounded, corner.cast<float>()).cast<double>());
    for (const unsigned axis : {1u, 2u, 4u}) {
      if (bits & axis) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        ImproveBySegments(best, corner, corner_of(bits | axis), triangle[i], triangle[(i + 1) % 3]);
      }
    }
  }
  return best;
}

}  // namespace

NearestPoints NearestPointsOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const TriangleCorners& triangle) {
  NearestPoints best{a, a, std::numeric_limits<double>::infinity(), false};
  Improve(best, a, NearestPointOf(triangle, a.cast<float>()).cast<double>());
  if (a == b) return best;
  Improve(best, b, NearestPointOf(triangle, b.cast<float>()).cast<double>());
  const Corners t = Exact(triangle);
  for (std::size_t i = 0; i < 3; ++i) ImproveBySegments(best, a, b, t[i], t[(i + 1) % 3]);
  if (const auto p = Crossing(a, b, t, UnitNormalOf(t))) best = {*p, *p, 0, true};
  return best;
}

std::optional<BodyTouch> TouchOf(const Capsule& capsule, const TriangleCorners& triangle, double padding_m) {
  const NearestPoints nearest = NearestPointsOf(capsule.a_m, capsule.b_m, triangle);
  const double reach_m = capsule.radius_m + padding_m;
  if (!(nearest.distance2 <= reach_m * reach_m)) return std::nullopt;
  const Corners t = Exact(triangle);
  const Eigen::Vector3d normal = UnitNormalOf(t);
  if (nearest.is_through) {
    const double lowest_m = std::min(normal.dot(capsule.a_m - t[0]), normal.dot(capsule.b_m - t[0]));
    return BodyTouch{reach_m - lowest_m, nearest.on_triangle, normal, true};
  }
  const double distance_m = std::sqrt(nearest.distance2),
               height_m = normal.dot(nearest.on_segment - nearest.on_triangle);
  return BodyTouch{reach_m - (height_m < 0 ? -distance_m : distance_m), nearest.on_triangle, normal, false, distance_m,
                   distance_m > 0 ? std::abs(height_m) / distance_m : 1};
}

std::optional<BodyTouch> TouchOf(const OrientedBox& box, const TriangleCorners& triangle, double padding_m) {
  const Transform T_box_world = box.T_world_box.inverse();
  Corners t = Exact(triangle);
  const Eigen::Vector3d normal = UnitNormalOf(t);
  TriangleCorners rounded;
  for (std::size_t i = 0; i < 3; ++i) {
    t[i] = T_box_world * t[i];
    rounded[i] = t[i].cast<float>();
  }
  if (const auto point = PointInBox(t, box.half_m)) {
    const Eigen::Vector3d n = T_box_world.linear() * normal;
    return BodyTouch{padding_m + n.cwiseAbs().dot(box.half_m) + n.dot(t[0]), box.T_world_box * *point, normal, true};
  }
  if (padding_m <= 0) return std::nullopt;
  const NearestPoints nearest = NearestToBox(t, rounded, box.half_m);
  if (!(nearest.distance2 <= padding_m * padding_m)) return std::nullopt;
  const double distance_m = std::sqrt(nearest.distance2);
  return BodyTouch{padding_m - distance_m, box.T_world_box * nearest.on_triangle, normal, false, distance_m};
}

}  // namespace dhpmap
