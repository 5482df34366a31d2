// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/trajectory_query.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace dhpmap {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// From the origin of the robot's frame.
double ReachOf(const std::vector<AttachedShape::Ball>& balls) {
  double reach_m = 0;
  for (const AttachedShape::Ball& ball : balls) reach_m = std::max(reach_m, ball.center_m.norm() + ball.radius_m);
  return reach_m;
}

/// If the penetration at the contact exceeds the smallest clearance, it becomes the smallest clearance.
void TakeDeeper(const TrajectoryContact& first, std::optional<TrajectoryClearance>& clearance) {
  const bool is_deeper = !clearance || -first.depth_then_m < clearance->least.distance_m;
  if (first.contact.submap == nullptr || first.depth_then_m <= 0 || !is_deeper) return;
  clearance = {
      {-first.depth_then_m, first.at, first.contact.point_m, first.contact.submap}, first.sphere, first.attached};
}

Status NobodyWaits() { return Cancelled("the client went away"); }

}  // namespace

TrajectoryQuery::TrajectoryQuery(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options)
    : options_(std::move(options)), surfaces_(std::move(surfaces)) {
  for (const std::vector<SubmapId>& may_touch : options_.spheres.lists) {
    spheres_.push_back(QueryOf(may_touch));
    if (options_.with_clearance) clear_of_.emplace_back(surfaces_, spheres_.back().options());
  }
}

SweepQuery TrajectoryQuery::QueryOf(const std::vector<SubmapId>& may_touch) const {
  BodyOptions bodies = options_.bodies;
  bodies.scope.may_touch = may_touch;
  return {surfaces_, std::move(bodies)};
}

Result<TrajectoryQuery> TrajectoryQuery::Make(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options,
                                              const std::stop_token& stop) {
  TrajectoryQuery query(std::move(surfaces), std::move(options));
  for (std::size_t i = 0; i < query.options_.attached.size(); ++i) {
    if (stop.stop_requested()) return NobodyWaits();
    const AttachedObject& attached = query.options_.attached[i];
    AttachedShape body = WholeBodyOf(*query.surfaces_, attached.submap, kMostBalls);
    if (body.num_balls > kMostBalls) {
      return ResourceExhausted("the trajectories cannot be checked")
          .WithViolation("options.attached[" + std::to_string(i) + "].submap", "is too large to be carried");
    }
    Carried& carried = query.carried_.emplace_back(Carried{std::move(body), query.QueryOf(attached.may_touch)});
    if (query.options_.with_clearance) carried.clearance.emplace(query.surfaces_, carried.query.options());
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
    contact.depth_then_m = found.first->depth_then_m;
    if (!is_all) answer.contacts.clear();
    answer.contacts.push_back(contact);
    if (round >= options_.max_contacts || stop.stop_requested() || !SpendOf(work, 1)) return;
    if (contact.contact.submap != nullptr) left.scope.may_touch.push_back(contact.contact.submap->id);
    else left.unknown = UnknownSpace::kFree;  // report it only once
    // Beyond the touched surface the motion is soon behind surfaces that it never touches.
    found = sweep(SweepQuery(surfaces_, left, /*counts_inside=*/false), kNever);
  }
}

SweepAnswer TrajectoryQuery::SweepAttached(const SweepQuery& query, const AttachedShape& body, const RigidPath& path,
                                           double until, const std::stop_token& stop, WorkBudget* work) {
  SweepAnswer best;
  for (const AttachedShape::Group& group : body.groups) {
    if (stop.stop_requested() || !SpendOf(work, 1)) break;
    const SweepAnswer rough =
        query.First(path.Carried(group.around.center_m, group.around.radius_m), until, stop, work);
    if (!rough.first && !rough.unknown_at) continue;
    for (const AttachedShape::Ball& ball : group.balls) {
      if (stop.stop_requested() || !SpendOf(work, 1)) break;  // on a long motion each ball takes a while
      const SweepAnswer found = query.First(path.Carried(ball.center_m, ball.radius_m), until, stop, work);
      if (found.unknown_at) best.unknown_at = std::min(found.unknown_at.value(), best.unknown_at.value_or(kNever));
      if (!found.first || (best.first && best.first->at <= found.first->at)) continue;
      best.first = found.first;
      until = found.first->at;
    }
  }
  return best;
}

std::optional<TrajectoryClearance> TrajectoryQuery::ClearanceOf(const RobotMotion& motion, const std::stop_token& stop,
                                                                WorkBudget* work) const {
  TrajectoryClearance found{.least = {.distance_m = options_.bodies.max_distance_m}};
  LeastClearance& least = found.least;
  const auto add_sphere = [&](std::size_t number, std::span<const SphereKnot> knots) {
    const std::size_t list = options_.spheres.ListOf(number);
    bool is_nearer = clear_of_[list].Lower(knots, least, stop, work);
    if (const auto inside = knots.empty() ? std::nullopt : spheres_[list].InsideOf(knots.front().center_m)) {
      const double clear_m = inside->distance_m - knots.front().radius_m;
      is_nearer = is_nearer || clear_m < least.distance_m;
      if (clear_m < least.distance_m) least = {clear_m, knots.front().at, inside->nearest_m, inside->submap};
    }
    if (is_nearer) found.sphere = number;
  };
  for (std::size_t i = 0; i < motion.spheres.size(); ++i) add_sphere(i, motion.spheres[i]);
  const RigidPath robot_path(motion.waypoints, ReachOf(motion.robot));
  for (std::size_t i = 0; i < motion.robot.size(); ++i) {
    add_sphere(motion.spheres.size() + i, robot_path.Carried(motion.robot[i].center_m, motion.robot[i].radius_m));
  }
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    const RigidPath path(motion.attached[i], carried_[i].body.reach_m);
    for (const AttachedShape::Group& group : carried_[i].body.groups) {
      if (stop.stop_requested() || !SpendOf(work, 1)) return std::nullopt;
      LeastClearance around = least;
      const ClearanceQuery& query = *carried_[i].clearance;
      if (!query.Lower(path.Carried(group.around.center_m, group.around.radius_m), around, stop, work)) continue;
      for (const AttachedShape::Ball& ball : group.balls) {
        if (!query.Lower(path.Carried(ball.center_m, ball.radius_m), least, stop, work)) continue;
        found.sphere.reset();
        found.attached = i;
      }
    }
  }
  return least.submap != nullptr ? std::optional(found) : std::nullopt;
}

Result<TrajectoryAnswer> TrajectoryQuery::Check(const RobotMotion& motion, const std::stop_token& stop,
                                                WorkBudget* work) const {
  TrajectoryAnswer answer;
  double unknown_at = kNever;
  const auto is_over = [&] { return stop.stop_requested() || !SpendOf(work, 1); };
  const auto add_sphere = [&](std::size_t number, std::span<const SphereKnot> knots) {
    const auto sweep = [&](const SweepQuery& query, double until) { return query.First(knots, until, stop, work); };
    Add(spheres_[options_.spheres.ListOf(number)], {.at = 0, .sphere = number, .attached = {}, .contact = {}}, sweep,
        stop, work, answer, unknown_at);
  };
  for (std::size_t i = 0; i < motion.spheres.size(); ++i) {
    if (is_over()) return NobodyWaits();
    add_sphere(i, motion.spheres[i]);
  }
  const RigidPath robot_path(motion.waypoints, ReachOf(motion.robot));
  for (std::size_t i = 0; i < motion.robot.size(); ++i) {
    if (is_over()) return NobodyWaits();
    const AttachedShape::Ball& ball = motion.robot[i];
    add_sphere(motion.spheres.size() + i, robot_path.Carried(ball.center_m, ball.radius_m));
  }
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    if (is_over()) return NobodyWaits();
    const RigidPath path(motion.attached[i], carried_[i].body.reach_m);
    const auto sweep = [&](const SweepQuery& query, double until) {
      return SweepAttached(query, carried_[i].body, path, until, stop, work);
    };
    Add(carried_[i].query, {.at = 0, .sphere = {}, .attached = i, .contact = {}}, sweep, stop, work, answer,
        unknown_at);
  }
  if (options_.with_clearance) answer.clearance = ClearanceOf(motion, stop, work);
  if (is_over()) return NobodyWaits();  // then the check is incomplete
  std::stable_sort(answer.contacts.begin(), answer.contacts.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
  if (answer.contacts.size() > options_.max_contacts) answer.contacts.resize(options_.max_contacts);
  answer.is_valid = answer.contacts.empty();
  if (options_.with_clearance && !answer.is_valid) TakeDeeper(answer.contacts.front(), answer.clearance);
  answer.is_unknown = unknown_at < kNever && (answer.is_valid || unknown_at <= answer.contacts.front().at);
  return answer;
}

}  // namespace dhpmap
