// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/shape/upright_box.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {

UprightBox BoxOver(const ConvexOutline& footprint_m, double low_m, double high_m) {
  return BoxOn(LeastRectangle(footprint_m), low_m, high_m);
}

UprightBox BoxOn(const Rectangle& rectangle, double low_m, double high_m) {
  return {.center_m = {rectangle.center.x(), rectangle.center.y(), (low_m + high_m) / 2},
          .yaw_rad = std::atan2(rectangle.across.y(), rectangle.across.x()),
          .size_m = {rectangle.size.x(), rectangle.size.y(), high_m - low_m}};
}

ConvexOutline FootprintOf(const UprightBox& box) {
  const Eigen::Vector2d across(std::cos(box.yaw_rad), std::sin(box.yaw_rad));
  const Eigen::Vector2d first = box.size_m.x() / 2 * across;
  const Eigen::Vector2d second = box.size_m.y() / 2 * Eigen::Vector2d(-across.y(), across.x());
  const Eigen::Vector2d center = box.center_m.head<2>();
  return ConvexHull(
      {center + first + second, center - first + second, center - first - second, center + first - second});
}

double IntersectionOverUnion(const UprightBox& a, const UprightBox& b) {
  const double low = std::max(a.center_m.z() - a.size_m.z() / 2, b.center_m.z() - b.size_m.z() / 2);
  const double high = std::min(a.center_m.z() + a.size_m.z() / 2, b.center_m.z() + b.size_m.z() / 2);
  const double common = AreaOf(Intersection(FootprintOf(a), FootprintOf(b))) * std::max(0.0, high - low);
  const double all = a.size_m.prod() + b.size_m.prod() - common;
  return all > 0 ? common / all : 0;
}

}  // namespace dhpmap
