// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/shape/convex_outline.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace dhpmap {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Eigen::Vector2d QuarterTurn(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The rectangle around the hull whose first axis is `along`, of length 1.
Rectangle RectangleAlong(const ConvexOutline& hull, const Eigen::Vector2d& along) {
  const Eigen::Vector2d upward = QuarterTurn(along);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Eigen::Vector2d& corner : hull) {
    const Eigen::Vector2d p(along.dot(corner), upward.dot(corner));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector2d middle = (low + high) / 2;
  return {middle.x() * along + middle.y() * upward, along, high - low};
}

}  // namespace

Rectangle Ordered(Rectangle rectangle) {
  if (rectangle.size.x() < rectangle.size.y()) {
    std::swap(rectangle.size.x(), rectangle.size.y());
    rectangle.across = QuarterTurn(rectangle.across);
  }
  const Eigen::Vector2d& across = rectangle.across;
  if (across.x() < 0 || (across.x() == 0 && across.y() < 0)) rectangle.across = -rectangle.across;
  return rectangle;
}

ConvexOutline ConvexHull(std::vector<Eigen::Vector2d> points) {
  const auto is_before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), is_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  ConvexOutline hull;
  const auto add = [&hull](const Eigen::Vector2d& p, std::size_t least) {
    while (hull.size() > least && Cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Eigen::Vector2d& p : points) add(p, 1);
  const std::size_t num_below = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], num_below);
  hull.pop_back();  // the first point again
  return hull;
}

Rectangle LeastRectangle(const ConvexOutline& hull) {
  Rectangle least{hull.front(), Eigen::Vector2d::UnitX(), Eigen::Vector2d::Zero()};
  double least_area = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; hull.size() > 1 && i < hull.size(); ++i) {
    const Rectangle around = RectangleAlong(hull, (hull[(i + 1) % hull.size()] - hull[i]).normalized());
    if (around.size.prod() >= least_area) continue;
    least_area = around.size.prod();
    least = around;
  }
  return Ordered(least);
}

double AreaOf(const ConvexOutline& hull) {
  double twice = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    twice += Cross(hull[i] - hull.front(), hull[(i + 1) % hull.size()] - hull.front());
  }
  return twice / 2;
}

ConvexOutline Intersection(const ConvexOutline& a, const ConvexOutline& b) {
  ConvexOutline left = a, cut;
  for (std::size_t side = 0; side < b.size(); ++side) {
    const Eigen::Vector2d &from = b[side], along = b[(side + 1) % b.size()] - from;
    cut.clear();
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Eigen::Vector2d &p = left[i], &q = left[(i + 1) % left.size()];
      const double of_p = Cross(along, p - from), of_q = Cross(along, q - from);
      if (of_p >= 0) cut.push_back(p);
      if ((of_p >= 0) != (of_q >= 0)) cut.push_back(p + of_p / (of_p - of_q) * (q - p));
    }
    left.swap(cut);
  }
  ConvexOutline common = ConvexHull(std::move(left));
  if (b.size() < 3 || common.size() < 3) common.clear();
  return common;
}

}  // namespace dhpmap
