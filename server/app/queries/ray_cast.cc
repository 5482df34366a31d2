// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/ray_cast.h"

#include <algorithm>
#include <cstddef>

namespace dhpmap {
namespace {

// Between batches the cache may evict surfaces, and the caller may take the answers.
constexpr std::size_t kRaysABatch = 256;

}  // namespace

Status CastRays(const MapView& view, SurfaceCache& cache, const DistanceQuestion& question, std::span<const Ray> rays,
                const std::stop_token& stop, const std::function<void(const RayHit&)>& take) {
  const RayOptions options{.max_distance_m = question.options.max_distance_m,
                           .unknown_is_free = question.options.unknown_is_free,
                           .scope = question.options.scope};
  const Transform T_query_map = question.T_map_query.inverse();
  for (std::size_t first = 0; first < rays.size(); first += kRaysABatch) {
    const RayQuery query(cache.Of(view.shared_snapshot(), options.scope.with_absent), options);
    for (const Ray& ray : rays.subspan(first, std::min(kRaysABatch, rays.size() - first))) {
      if (stop.stop_requested()) return Cancelled("the client went away");
      RayHit hit = query.Cast({question.T_map_query * ray.origin_m, question.T_map_query.linear() * ray.direction});
      hit.point_m = T_query_map * hit.point_m;
      hit.normal = T_query_map.linear() * hit.normal;
      take(hit);
    }
  }
  return Status::Ok();
}

}  // namespace dhpmap
