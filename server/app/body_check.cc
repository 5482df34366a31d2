// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/body_check.h"

#include <algorithm>
#include <variant>

namespace dhpmap {
namespace {

// Between two batches the cache may let go of surfaces.
constexpr std::size_t kBodiesABatch = 1024;

}  // namespace

void MoveContact(const Transform& T_query_map, BodyContact& contact) {
  contact.point_m = T_query_map * contact.point_m;
  contact.normal = T_query_map.linear() * contact.normal;
}

Status CheckBodies(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                   std::span<const Body> bodies, const std::stop_token& stop,
                   const std::function<void(const BodyAnswer&)>& take) {
  const Transform T_query_map = question.T_map_query.inverse();
  for (std::size_t first = 0; first < bodies.size(); first += kBodiesABatch) {
    const BodyQuery query(cache.Of(view.shared_snapshot(), question.options.scope.with_absent), question.options);
    for (const Body& body : bodies.subspan(first, std::min(kBodiesABatch, bodies.size() - first))) {
      if (stop.stop_requested()) return Cancelled("the client went away");
      const Body in_map = std::visit([&](const auto& b) -> Body { return Moved(question.T_map_query, b); }, body);
      BodyAnswer answer = question.max_contacts == 0 ? query.Test(in_map) : query.Check(in_map, question.max_contacts);
      for (BodyContact& contact : answer.contacts) MoveContact(T_query_map, contact);
      take(answer);
    }
  }
  return Status::Ok();
}

}  // namespace dhpmap
