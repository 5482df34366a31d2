// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/ompl/robot_world.h"

#include <ompl/base/spaces/SE2StateSpace.h>

#include <limits>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"

namespace dhpmap::client {

struct RobotWorld::Impl {
  std::shared_ptr<const Queries> queries;
  Spheres robot;
  QueryOptions options;
  PoseOfState pose_of;
  Mutex mutex;
  Status status DHPMAP_GUARDED_BY(mutex);
};

PoseOfState PoseOfSe2(double z_m) {
  return [z_m](const ompl::base::State* state) {
    const auto* se2 = state->as<ompl::base::SE2StateSpace::StateType>();
    return PoseAt({se2->getX(), se2->getY(), z_m}, se2->getYaw());
  };
}

RobotWorld::RobotWorld(std::shared_ptr<const Queries> queries, Spheres robot, QueryOptions options, PoseOfState pose_of)
    : impl_(new Impl{std::move(queries), std::move(robot), std::move(options), std::move(pose_of), {}, {}}) {}

RobotWorld::~RobotWorld() = default;

PathCheck RobotWorld::Check(std::span<const ompl::base::State* const> states, const CheckOptions& check) const {
  std::vector<Pose> waypoints;
  for (const ompl::base::State* state : states) waypoints.push_back(impl_->pose_of(state));
  Result<PathCheck> answer = impl_->queries->CheckPath(impl_->robot, waypoints, impl_->options, check);
  if (answer.ok()) return *std::move(answer);
  const MutexLock lock(impl_->mutex);
  if (impl_->status.ok()) impl_->status = answer.status();
  return {};
}

double RobotWorld::Clearance_m(const ompl::base::State* state) const {
  constexpr double kDefaultReach_m = 3;
  const PathCheck check = Check({&state, 1}, {.include_clearance = true});
  if (check.clearance) return check.clearance->distance_m;
  if (!status().ok()) return -std::numeric_limits<double>::infinity();
  return impl_->options.max_distance_m.value_or(kDefaultReach_m);
}

Status RobotWorld::status() const {
  const MutexLock lock(impl_->mutex);
  return impl_->status;
}

ompl::base::PlannerTerminationCondition RobotWorld::EndsOnFailure() const {
  return ompl::base::PlannerTerminationCondition([this] { return !status().ok(); });
}

}  // namespace dhpmap::client
