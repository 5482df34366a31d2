// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dhpmap {

/// Corners of a convex polygon of a plane, counterclockwise, no three of them on a line. One or two corners if all
/// points are equal or on one line.
using ConvexOutline = std::vector<Eigen::Vector2d>;

/// The convex hull (Andrew's monotone chain) of finite points, starting at the point of least x, then least y. Empty
/// for no points.
ConvexOutline ConvexHull(std::vector<Eigen::Vector2d> points);

/// A rectangle of a plane: `across` is its first axis, of length 1; the second is a quarter turn counterclockwise.
struct Rectangle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d across = Eigen::Vector2d::UnitX();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  ///< along the axes, the first no less than the second
};

/// The same rectangle in the form of LeastRectangle: the longer side first, `across` with x above 0, or +y.
Rectangle Ordered(Rectangle rectangle);

/// The rectangle of least area around a hull that is not empty (rotating callipers: one of its sides lies on one of the
/// hull's). Of equal ones the one found first along the hull. `across` has x above 0, or is +y.
Rectangle LeastRectangle(const ConvexOutline& hull);

/// The area of a hull.
double AreaOf(const ConvexOutline& hull);

/// The intersection of two hulls (Sutherland and Hodgman 1974). Empty if it has no area.
ConvexOutline Intersection(const ConvexOutline& a, const ConvexOutline& b);

}  // namespace dhpmap
