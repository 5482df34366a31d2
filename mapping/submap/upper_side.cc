// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/upper_side.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mapping/submap/submap_outline.h"
#include "mapping/submap/support_height.h"

namespace dhpmap {
namespace {

constexpr double kLeastUp = 0.70710678;  // cosine of 45 degrees

/// Of a submap, in the map frame.
std::vector<SurfaceCrossing> CrossingsInMap(const Submap& submap) {
  std::vector<SurfaceCrossing> crossings = FindSurfaceCrossings(submap);
  const Transform& T_map_submap = submap.info().T_map_submap;
  for (SurfaceCrossing& crossing : crossings) {
    crossing.p_m = T_map_submap * crossing.p_m;
    crossing.normal = T_map_submap.linear() * crossing.normal;
  }
  return crossings;
}

}  // namespace

std::optional<Eigen::Vector3d> MiddleOfUpperSide(const Submap& submap) {
  const auto outline = OutlineInMap(submap);
  if (!outline || !outline->support_height_m) return std::nullopt;
  std::vector<Eigen::Vector2d> level;
  for (const SurfaceCrossing& crossing : CrossingsInMap(submap)) {
    const bool is_level = std::abs(crossing.p_m.z() - *outline->support_height_m) <= submap.info().voxel_size_m;
    if (is_level && crossing.normal.z() >= kLeastLevel) level.emplace_back(crossing.p_m.head<2>());
  }
  const Eigen::Vector2d middle_m = LeastRectangle(ConvexHull(std::move(level))).center;
  return Eigen::Vector3d(middle_m.x(), middle_m.y(), *outline->support_height_m);
}

std::optional<Eigen::Vector3d> SurfaceFromAbove(const Submap& submap, const Eigen::Vector2d& point_m) {
  const double near_m = kLevel_vox * submap.info().voxel_size_m;
  std::vector<SurfaceCrossing> there = CrossingsInMap(submap);
  std::erase_if(there, [&](const SurfaceCrossing& c) { return (c.p_m.head<2>() - point_m).norm() > near_m; });
  std::vector<double> heights_m = HeightsFacingUp(there, kLeastUp);
  if (heights_m.empty()) return std::nullopt;
  const auto first = std::lower_bound(heights_m.begin(), heights_m.end(), heights_m.back() - near_m);
  return Eigen::Vector3d(point_m.x(), point_m.y(), *(first + (heights_m.end() - first) / 2));
}

}  // namespace dhpmap
