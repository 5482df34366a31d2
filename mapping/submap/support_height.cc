// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/support_height.h"

#include <algorithm>
#include <cstddef>

namespace dhpmap {
namespace {

constexpr double kShareOfLargest = 0.5, kShareOfFootprint = 0.25;
constexpr std::size_t kFewest = 4;  // crossings of a level part

}  // namespace

std::vector<double> HeightsFacingUp(const std::vector<SurfaceCrossing>& crossings, double least_up) {
  std::vector<double> heights_m;
  for (const SurfaceCrossing& crossing : crossings) {
    if (crossing.normal.z() >= least_up) heights_m.push_back(crossing.p_m.z());
  }
  std::sort(heights_m.begin(), heights_m.end());
  return heights_m;
}

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

}  // namespace dhpmap
