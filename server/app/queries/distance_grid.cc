// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/distance_grid.h"

#include <algorithm>

namespace dhpmap {

Result<std::span<const SurfaceDistance>> DistanceGrid::NextBatch(const std::stop_token& stop) {
  const std::int64_t end = std::min(next_ + static_cast<std::int64_t>(kMostInBatch), question_.num_nodes());
  points_m_.clear();
  answers_.clear();
  for (std::int64_t n = next_; n < end; ++n) {
    const std::int64_t i = n % question_.size.x(), row = n / question_.size.x();
    const Eigen::Vector3d node(static_cast<double>(i), static_cast<double>(row % question_.size.y()),
                               static_cast<double>(row / question_.size.y()));
    points_m_.push_back(question_.corner_m + question_.resolution_m * node);
  }
  DHPMAP_RETURN_IF_ERROR(LookUpDistances(*view_, *cache_, question_.distances, points_m_, stop, InPlace,
                                         [this](const SurfaceDistance& answer) { answers_.push_back(answer); }));
  next_ = end;
  return std::span<const SurfaceDistance>(answers_);
}

}  // namespace dhpmap
