// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/trajectory_check.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

// Between two batches the cache may let go of surfaces.
constexpr std::size_t kMotionsABatch = 64;

void MoveToMap(const Transform& T_map_query, RobotMotion& motion) {
  for (auto& sphere : motion.spheres) {
    for (SphereKnot& knot : sphere) knot.center_m = T_map_query * knot.center_m;
  }
  for (Transform& T : motion.waypoints) T = T_map_query * T;
  for (auto& poses : motion.attached) {
    for (Transform& T : poses) T = T_map_query * T;
  }
}

}  // namespace

Status CheckTrajectories(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                         std::size_t num_motions, const std::function<RobotMotion(std::size_t)>& motion_of,
                         const std::stop_token& stop, const std::function<void(const TrajectoryAnswer&)>& take) {
  const Transform T_query_map = question.T_map_query.inverse();
  TrajectoryOptions options{.bodies = question.options, .attached = {}, .max_contacts = question.max_contacts};
  for (const CarriedSubmap& carried : question.attached) {
    options.attached.push_back({carried.submap, carried.may_touch});
  }
  for (std::size_t first = 0; first < num_motions; first += kMotionsABatch) {
    DHPMAP_ASSIGN_OR_RETURN(
        const TrajectoryQuery query,
        TrajectoryQuery::Make(cache.Of(view.shared_snapshot(), options.bodies.scope.with_absent), options, stop));
    for (std::size_t i = first; i < std::min(first + kMotionsABatch, num_motions); ++i) {
      RobotMotion motion = motion_of(i);
      MoveToMap(question.T_map_query, motion);
      DHPMAP_ASSIGN_OR_RETURN(TrajectoryAnswer answer, query.Check(motion, stop));
      for (TrajectoryContact& contact : answer.contacts) MoveContact(T_query_map, contact.contact);
      take(answer);
    }
  }
  return Status::Ok();
}

}  // namespace dhpmap
