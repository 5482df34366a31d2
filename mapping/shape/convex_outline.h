// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dhpmap {

/// Corners of a convex polygon of a plane, counterclockwise, none of them between two others on a line. One or two, of
/// points that are at one place or on one line.
using ConvexOutline = std::vector<Eigen::Vector2d>;

/// The convex hull (Andrew's monotone chain), from the point of least x, of these of least y. None for no points, all
/// of which are finite.
ConvexOutline ConvexHull(std::vector<Eigen::Vector2d> points);

/// A rectangle of a plane: `across` is its first axis, of length 1; the second is a quarter turn counterclockwise.
struct Rectangle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d across = Eigen::Vector2d::UnitX();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  ///< along the axes, the first no less than the second
};

/// The same one, told as LeastRectangle tells it: the longer side first, `across` with x above 0, or +y.
Rectangle Ordered(Rectangle rectangle);

/// The rectangle of least area around a hull that is not empty (rotating callipers: one of its sides lies on one of the
/// hull's). Of equal ones the one found first along the hull. `across` has x above 0, or is +y.
Rectangle LeastRectangle(const ConvexOutline& hull);

/// The area of a hull.
double AreaOf(const ConvexOutline& hull);

/// What two hulls have in common (Sutherland and Hodgman 1974). Empty if that has no area.
ConvexOutline Intersection(const ConvexOutline& a, const ConvexOutline& b);

}  // namespace dhpmap
