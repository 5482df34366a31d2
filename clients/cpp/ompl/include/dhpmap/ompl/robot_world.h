// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/State.h>

#include <functional>
#include <memory>
#include <span>

#include "dhpmap/answers.h"
#include "dhpmap/options.h"
#include "dhpmap/queries.h"

namespace dhpmap::client {

/// Where a state puts the robot: T_map_robot.
using PoseOfState = std::function<Pose(const ompl::base::State*)>;
/// Of a state of ompl::base::SE2StateSpace: at its x and y, z_m above the floor, turned by its yaw.
PoseOfState PoseOfSe2(double z_m = 0);

/// A robot in a map, as planners ask about it. Meant for a Loop, pinned or not, or a Pinned; any Queries do. What
/// fails, such as a lost server, counts as not valid, and is kept: look at status() when a planner has found nothing.
/// Thread-safe where its Queries are, and a Loop takes planners of several threads, too: they take turns.
class RobotWorld {
 public:
  RobotWorld(std::shared_ptr<const Queries> queries, Spheres robot, QueryOptions options, PoseOfState pose_of);
  ~RobotWorld();
  RobotWorld(const RobotWorld&) = delete;
  RobotWorld& operator=(const RobotWorld&) = delete;

  /// Whether the robot can go from state to state; of one state, whether it can be there. ok is false after a failure.
  [[nodiscard]] PathCheck Check(std::span<const ompl::base::State* const> states, const CheckOptions& check = {}) const;
  /// The distance (m) from the robot's surface to the nearest that it must not touch, below 0 inside; at most
  /// max_distance_m of the options (default 3). After a failure: minus infinity.
  [[nodiscard]] double Clearance_m(const ompl::base::State* state) const;

  /// OK, or the first failure.
  [[nodiscard]] Status status() const;
  /// Ends a planner as soon as something fails. The world must outlive it.
  [[nodiscard]] ompl::base::PlannerTerminationCondition EndsOnFailure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::client
