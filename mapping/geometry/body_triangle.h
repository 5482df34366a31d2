// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "mapping/geometry/body.h"
#include "mapping/geometry/triangle_tree.h"

namespace dhpmap {

/// Contact of a body with a triangle, in the frame of both.
struct BodyTouch {
  /// Shortest translation along the triangle's normal, or from it to the body's axis, that ends the contact. Not
  /// negative.
  double depth_m;
  Eigen::Vector3d point;   ///< on the triangle
  Eigen::Vector3d normal;  ///< of the triangle, unit, to its front
  bool is_through;         ///< the triangle intersects the axis of a capsule, or a box without its padding
  double distance_m = 0;   ///< from the axis, or the box
  double slant = 0;        ///< component of that direction along the triangle's normal: 1 is perpendicular

  /// Whether this contact describes the penetration of the common surface better: the shortest way out if the surface
  /// passes through the body, else the nearest point. Among triangles with a common edge or corner, the most
  /// perpendicular one determines the side.
  [[nodiscard]] bool TellsMoreThan(const BodyTouch& other) const {
    constexpr double kSame_m = 1e-6;
    if (is_through != other.is_through) return is_through;
    if (is_through) return depth_m < other.depth_m;
    if (std::abs(distance_m - other.distance_m) > kSame_m) return distance_m < other.distance_m;
    return slant > other.slant;
  }
};

/// The contact of a body, grown by padding_m, with a triangle, if they intersect. Exact up to single-precision rounding
/// of coordinates of a few metres. A triangle without an area has no contact.
std::optional<BodyTouch> TouchOf(const Capsule& capsule, const TriangleCorners& triangle, double padding_m);
std::optional<BodyTouch> TouchOf(const OrientedBox& box, const TriangleCorners& triangle, double padding_m);

/// The closest points of a segment (possibly a point) and a triangle; equal if they intersect.
struct NearestPoints {
  Eigen::Vector3d on_segment, on_triangle;
  double distance2;
  bool is_through;
};
NearestPoints NearestPointsOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const TriangleCorners& triangle);

}  // namespace dhpmap
