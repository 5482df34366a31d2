// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/trajectory_check.h"

#include <algorithm>
#include <utility>

#include "mapping/query/work_budget.h"

namespace dhpmap {
namespace {

// The cache may evict surfaces between batches.
constexpr std::size_t kMotionsABatch = 64;

Status NobodyWaitsForMotions() { return Cancelled("the client went away"); }

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

TrajectoryCheck::TrajectoryCheck(std::shared_ptr<const MapSnapshot> state, SurfaceCache& cache, CheckQuestion question,
                                 std::size_t num_motions, MotionOf motion_of, std::int64_t most_work)
    : state_(std::move(state)),
      cache_(cache),
      question_(std::move(question)),
      num_motions_(num_motions),
      motion_of_(std::move(motion_of)),
      work_left_(most_work) {}

Status TrajectoryCheck::MakeQuery(const std::stop_token& stop) {
  TrajectoryOptions options{.bodies = question_.options,
                            .attached = {},
                            .spheres = question_.parts,
                            .max_contacts = question_.max_contacts,
                            .with_clearance = question_.with_clearance};
  for (const AttachedSubmap& carried : question_.attached) {
    options.attached.push_back({carried.submap, carried.may_touch});
  }
  auto surfaces = cache_.Of(state_, options.bodies.scope.with_absent);
  DHPMAP_ASSIGN_OR_RETURN(TrajectoryQuery query, TrajectoryQuery::Make(std::move(surfaces), std::move(options), stop));
  query_.emplace(std::move(query));
  query_ends_ = std::min(next_ + kMotionsABatch, num_motions_);
  return Status::Ok();
}

Result<bool> TrajectoryCheck::Next(const CheckPiece& piece, const std::stop_token& stop,
                                   const std::function<void(const TrajectoryAnswer&)>& take) {
  if (next_ == num_motions_) return false;
  if (next_ == query_ends_) DHPMAP_RETURN_IF_ERROR(MakeQuery(stop));
  const Transform T_query_map = question_.T_map_query.inverse();
  WorkBudget work(piece.may_overrun ? work_left_ : std::min(work_left_, piece.work), stop);
  for (; next_ < query_ends_ && work.spent() < piece.work; ++next_) {
    RobotMotion motion = motion_of_(next_);
    MoveToMap(question_.T_map_query, motion);
    auto answer = query_->Check(motion, stop, &work);
    if (stop.stop_requested() || (!answer.ok() && !work.is_over()))
      return answer.ok() ? NobodyWaitsForMotions() : answer.status();
    if (work.is_over()) break;
    for (TrajectoryContact& contact : answer->contacts) MoveContact(T_query_map, contact.contact);
    if (answer->clearance) answer->clearance->least.point_m = T_query_map * answer->clearance->least.point_m;
    take(*answer);
  }
  if (next_ == num_motions_) return false;
  work_left_ -= work.spent();
  if (work_left_ <= 0) return TooMuchWork("trajectories");
  return true;
}

Status CheckTrajectories(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                         std::size_t num_motions, const std::function<RobotMotion(std::size_t)>& motion_of,
                         const std::stop_token& stop, const std::function<void(const TrajectoryAnswer&)>& take) {
  TrajectoryCheck check(view.shared_snapshot(), cache, question, num_motions, motion_of);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_more, check.Next({}, stop, take));
    if (!has_more) return Status::Ok();
  }
}

}  // namespace dhpmap
