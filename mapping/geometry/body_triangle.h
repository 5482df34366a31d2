// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "mapping/geometry/body.h"
#include "mapping/geometry/triangle_tree.h"

namespace dhpmap {

/// How a body touches a triangle, in the frame of both.
struct BodyTouch {
  /// The way along the triangle's normal, or from it to the body's axis, that would take the body off it. Not negative.
  double depth_m;
  Eigen::Vector3d point;   ///< on the triangle
  Eigen::Vector3d normal;  ///< of the triangle, unit, to its front
  bool is_through;         ///< the triangle goes through the axis of a capsule, or into a box without its padding
  double distance_m = 0;   ///< from the axis, or the box
  double slant = 0;        ///< of the way from the triangle to there against its plane: 1 straight away from it

  /// Whether this tells more of how deep the body is in the surface that both triangles are of: the least way out, if
  /// the surface goes through it, else the way to what is nearest. Of triangles with a common edge or corner, the one
  /// from which it goes away straightest tells the side.
  [[nodiscard]] bool TellsMoreThan(const BodyTouch& other) const {
    constexpr double kSame_m = 1e-6;
    if (is_through != other.is_through) return is_through;
    if (is_through) return depth_m < other.depth_m;
    if (std::abs(distance_m - other.distance_m) > kSame_m) return distance_m < other.distance_m;
    return slant > other.slant;
  }
};

/// Whether a body, grown by padding_m, has a point with a triangle in common, and if so how. Exact to rounding in
/// single precision of the triangle's coordinates: a few metres at most. A triangle without an area is not touched.
std::optional<BodyTouch> TouchOf(const Capsule& capsule, const TriangleCorners& triangle, double padding_m);
std::optional<BodyTouch> TouchOf(const OrientedBox& box, const TriangleCorners& triangle, double padding_m);

/// Of a segment (which may be a point) and a triangle the points that are nearest to each other; the same one, where
/// it goes through.
struct NearestPoints {
  Eigen::Vector3d on_segment, on_triangle;
  double distance2;
  bool is_through;
};
NearestPoints NearestPointsOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const TriangleCorners& triangle);

}  // namespace dhpmap
