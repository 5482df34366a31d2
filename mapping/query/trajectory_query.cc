// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/trajectory_query.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace dhpmap {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Status NobodyWaits() { return Cancelled("the client went away"); }

}  // namespace

Result<TrajectoryQuery> TrajectoryQuery::Make(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options,
                                              const std::stop_token& stop) {
  TrajectoryQuery query(std::move(surfaces), std::move(options));
  for (std::size_t i = 0; i < query.options_.attached.size(); ++i) {
    if (stop.stop_requested()) return NobodyWaits();
    const AttachedObject& attached = query.options_.attached[i];
    CarriedBody body = WholeBodyOf(*query.surfaces_, attached.submap, kMostBalls);
    if (body.num_balls > kMostBalls) {
      return ResourceExhausted("the trajectories cannot be checked")
          .WithViolation("options.attached[" + std::to_string(i) + "].submap", "is too large to be carried");
    }
    BodyOptions bodies = query.options_.bodies;
    auto& excluded = bodies.scope.excluded_submaps;
    excluded.insert(excluded.end(), attached.may_touch.begin(), attached.may_touch.end());
    query.carried_.push_back({std::move(body), SweepQuery(query.surfaces_, std::move(bodies))});
  }
  return query;
}

template <typename Sweep>
void TrajectoryQuery::Add(const SweepQuery& query, const TrajectoryContact& part, const Sweep& sweep,
                          const std::stop_token& stop, WorkBudget* work, TrajectoryAnswer& answer,
                          double& unknown_at) const {
  const bool is_all = options_.max_contacts > 1;
  const double until = is_all || answer.contacts.empty() ? kNever : answer.contacts.front().at;
  SweepAnswer found = sweep(query, until);
  BodyOptions left = query.options();
  for (std::size_t round = 1;; ++round) {
    if (found.unknown_at) unknown_at = std::min(unknown_at, *found.unknown_at);
    if (!found.first || (!is_all && found.first->at >= until)) return;
    TrajectoryContact contact = part;
    contact.at = found.first->at;
    contact.contact = found.first->contact;
    if (!is_all) answer.contacts.clear();
    answer.contacts.push_back(contact);
    if (round >= options_.max_contacts || stop.stop_requested() || !SpendOf(work, 1)) return;
    if (contact.contact.submap != nullptr) left.scope.excluded_submaps.push_back(contact.contact.submap->id);
    else left.unknown = UnknownSpace::kFree;  // told once
    // Beyond the surface of what it met, it is soon behind surfaces that it never touches.
    found = sweep(SweepQuery(surfaces_, left, /*counts_inside=*/false), kNever);
  }
}

SweepAnswer TrajectoryQuery::SweepCarried(const SweepQuery& query, const CarriedBody& body, const RigidPath& path,
                                          double until, const std::stop_token& stop, WorkBudget* work) {
  SweepAnswer best;
  for (const CarriedBody::Group& group : body.groups) {
    if (stop.stop_requested() || !SpendOf(work, 1)) break;
    const SweepAnswer rough =
        query.First(path.Carried(group.around.center_m, group.around.radius_m), until, stop, work);
    if (!rough.first && !rough.unknown_at) continue;
    for (const CarriedBody::Ball& ball : group.balls) {
      if (stop.stop_requested() || !SpendOf(work, 1)) break;  // on a long way each takes its time
      const SweepAnswer found = query.First(path.Carried(ball.center_m, ball.radius_m), until, stop, work);
      if (found.unknown_at) best.unknown_at = std::min(found.unknown_at.value(), best.unknown_at.value_or(kNever));
      if (!found.first || (best.first && best.first->at <= found.first->at)) continue;
      best.first = found.first;
      until = found.first->at;
    }
  }
  return best;
}

Result<TrajectoryAnswer> TrajectoryQuery::Check(const RobotMotion& motion, const std::stop_token& stop,
                                                WorkBudget* work) const {
  TrajectoryAnswer answer;
  double unknown_at = kNever;
  const auto is_over = [&] { return stop.stop_requested() || !SpendOf(work, 1); };
  const auto add_sphere = [&](std::size_t number, std::span<const SphereKnot> knots) {
    const auto sweep = [&](const SweepQuery& query, double until) { return query.First(knots, until, stop, work); };
    Add(robot_, {.at = 0, .sphere = number, .attached = {}, .contact = {}}, sweep, stop, work, answer, unknown_at);
  };
  for (std::size_t i = 0; i < motion.spheres.size(); ++i) {
    if (is_over()) return NobodyWaits();
    add_sphere(i, motion.spheres[i]);
  }
  double reach_m = 0;
  for (const CarriedBody::Ball& ball : motion.robot) {
    reach_m = std::max(reach_m, ball.center_m.norm() + ball.radius_m);
  }
  const RigidPath robot_path(motion.waypoints, reach_m);
  for (std::size_t i = 0; i < motion.robot.size(); ++i) {
    if (is_over()) return NobodyWaits();
    const CarriedBody::Ball& ball = motion.robot[i];
    add_sphere(motion.spheres.size() + i, robot_path.Carried(ball.center_m, ball.radius_m));
  }
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    if (is_over()) return NobodyWaits();
    const RigidPath path(motion.attached[i], carried_[i].body.reach_m);
    const auto sweep = [&](const SweepQuery& query, double until) {
      return SweepCarried(query, carried_[i].body, path, until, stop, work);
    };
    Add(carried_[i].query, {.at = 0, .sphere = {}, .attached = i, .contact = {}}, sweep, stop, work, answer,
        unknown_at);
  }
  if (is_over()) return NobodyWaits();  // then not all was looked at
  std::stable_sort(answer.contacts.begin(), answer.contacts.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
  if (answer.contacts.size() > options_.max_contacts) answer.contacts.resize(options_.max_contacts);
  answer.is_valid = answer.contacts.empty();
  answer.is_unknown = unknown_at < kNever && (answer.is_valid || unknown_at <= answer.contacts.front().at);
  return answer;
}

}  // namespace dhpmap
