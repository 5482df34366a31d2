// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/distance_lookup.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dhpmap {
namespace {

// Between two batches the cache may let go of surfaces, and the caller of the answer.
constexpr std::size_t kBatch = 2048;

}  // namespace

Status LookUpDistances(const MapView& view, SurfaceCache& cache, const DistanceQuestion& question,
                       std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop,
                       const std::function<void(const SurfaceDistance&)>& take) {
  const bool is_map_frame = IsIdentity(question.T_map_query);
  const Transform T_query_map = question.T_map_query.inverse();
  std::vector<Eigen::Vector3d> points_map;
  std::vector<SurfaceDistance> answers;
  for (std::size_t first = 0; first < points_m.size(); first += kBatch) {
    if (stop.stop_requested()) return Cancelled("the client went away");
    const auto batch = points_m.subspan(first, std::min(kBatch, points_m.size() - first));
    points_map.assign(batch.begin(), batch.end());
    if (!is_map_frame) {
      for (Eigen::Vector3d& p : points_map) p = question.T_map_query * p;
    }
    answers.assign(batch.size(), {});
    DistanceQuery(cache.Of(view.shared_snapshot()), question.options).At(points_map, answers);
    for (SurfaceDistance& answer : answers) {
      if (!is_map_frame) {
        answer.gradient = T_query_map.linear() * answer.gradient;
        answer.nearest_m = T_query_map * answer.nearest_m;
      }
      take(answer);
    }
  }
  return Status::Ok();
}

}  // namespace dhpmap
