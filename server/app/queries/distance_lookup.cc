// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/distance_lookup.h"

#include <vector>

#include "server/app/queries/point_pieces.h"

namespace dhpmap {

Status LookUpDistances(const MapView& view, SurfaceCache& cache, const DistanceQuestion& question,
                       std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop, const Spread& spread,
                       const std::function<void(const SurfaceDistance&)>& take) {
  const bool is_map_frame = IsIdentity(question.T_map_query);
  const Transform T_query_map = question.T_map_query.inverse();
  std::vector<SurfaceDistance> answers;
  for (const auto batch : BatchesOf(points_m)) {
    if (stop.stop_requested()) return Cancelled("the client went away");
    answers.assign(batch.size(), {});
    // One for each batch: between batches the cache may evict surfaces, and the caller may take the answers.
    const DistanceQuery query(cache.Of(view.shared_snapshot(), question.options.scope.with_absent), question.options);
    SpreadAlongCurve(batch, spread, [&](std::span<const std::uint32_t> piece) {
      if (stop.stop_requested()) return;
      std::vector<Eigen::Vector3d> points_map;
      points_map.reserve(piece.size());
      for (const std::uint32_t i : piece) {
        points_map.push_back(is_map_frame ? batch[i] : question.T_map_query * batch[i]);
      }
      std::vector<SurfaceDistance> of_piece(piece.size());
      query.AtInOrder(points_map, of_piece);
      for (std::size_t k = 0; k < piece.size(); ++k) answers[piece[k]] = of_piece[k];
    });
    if (stop.stop_requested()) return Cancelled("the client went away");
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
