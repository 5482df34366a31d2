// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/upper_side.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mapping/map/submap_outline.h"

namespace dhpmap {
namespace {

constexpr double kLeastUp = 0.70710678, kLeastLevel = 0.90630779;  // cosines of 45 and 25 degrees
constexpr double kLevel_vox = 1.5;
constexpr double kShareOfLargest = 0.5, kShareOfFootprint = 0.25;
constexpr std::size_t kFewest = 4;  // crossings of a level part

std::vector<double> HeightsFacingUp(const std::vector<SurfaceCrossing>& crossings, double least_up) {
  std::vector<double> heights_m;
  for (const SurfaceCrossing& crossing : crossings) {
    if (crossing.normal.z() >= least_up) heights_m.push_back(crossing.p_m.z());
  }
  std::sort(heights_m.begin(), heights_m.end());
  return heights_m;
}

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

std::optional<double> SupportHeight(const std::vector<SurfaceCrossing>& crossings, double voxel_size_m,
                                    double footprint_m2) {
  const std::vector<double> heights_m = HeightsFacingUp(crossings, kLeastLevel);
  const double level_m = kLevel_vox * voxel_size_m;
  // Of each height, how many there are from a level below it up to it.
  std::vector<std::size_t> counts;
  for (std::size_t top = 0, bottom = 0; top < heights_m.size(); ++top) {
    while (heights_m[bottom] < heights_m[top] - level_m) ++bottom;
    counts.push_back(top - bottom + 1);
  }
  const std::size_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  const double most_m2 = static_cast<double>(most) * voxel_size_m * voxel_size_m;
  if (most < kFewest || most_m2 < kShareOfFootprint * footprint_m2) return std::nullopt;
  // The highest that is large enough, and of those within a level below it the largest.
  std::size_t best = heights_m.size() - 1;
  while (static_cast<double>(counts[best]) < kShareOfLargest * static_cast<double>(most)) --best;
  const double highest_m = heights_m[best];
  for (std::size_t i = best; i-- > 0 && heights_m[i] >= highest_m - level_m;) {
    if (counts[i] > counts[best]) best = i;
  }
  return heights_m[best - counts[best] / 2];
}

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
