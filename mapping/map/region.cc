// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/region.h"

namespace dhpmap {

bool Contains(const Region& region, const Eigen::Vector3d& p_map_m) {
  if (const auto* box = std::get_if<Eigen::AlignedBox3d>(&region)) return box->contains(p_map_m);
  return std::get<BoundingSphere>(region).Contains(p_map_m);
}

bool Touches(const Region& region, const Eigen::Vector3d& center_map_m, double radius_m) {
  if (const auto* box = std::get_if<Eigen::AlignedBox3d>(&region)) {
    return box->squaredExteriorDistance(center_map_m) <= radius_m * radius_m;
  }
  const auto& sphere = std::get<BoundingSphere>(region);
  return (center_map_m - sphere.center_m).norm() <= radius_m + sphere.radius_m;
}

BoundingSphere SphereAround(const Region& region) {
  if (const auto* sphere = std::get_if<BoundingSphere>(&region)) return *sphere;
  const auto& box = std::get<Eigen::AlignedBox3d>(region);
  return {box.center(), box.diagonal().norm() / 2};
}

bool IsSame(const Region& a, const Region& b) {
  if (a.index() != b.index()) return false;
  if (const auto* box = std::get_if<Eigen::AlignedBox3d>(&a)) {
    const auto& other = std::get<Eigen::AlignedBox3d>(b);
    return box->min() == other.min() && box->max() == other.max();
  }
  const auto& sphere = std::get<BoundingSphere>(a);
  const auto& other = std::get<BoundingSphere>(b);
  return sphere.center_m == other.center_m && sphere.radius_m == other.radius_m;
}

}  // namespace dhpmap
