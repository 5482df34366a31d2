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

/// The robot's pose T_map_robot in a state.
using PoseOfState = std::function<Pose(const ompl::base::State*)>;
/// For states of ompl::base::SE2StateSpace: at their x and y, z_m above the floor, rotated by their yaw.
PoseOfState PoseOfSe2(double z_m = 0);

/// A robot in a map, for planners. Intended for a Loop, pinned or not, or a Pinned; any Queries work. Failures, such as
/// a lost server, count as invalid and are recorded: check status() if a planner finds nothing. Thread-safe if its
/// Queries are; a Loop may serve planners of several threads, too, which take turns.
class RobotWorld {
 public:
  RobotWorld(std::shared_ptr<const Queries> queries, Spheres robot, QueryOptions options, PoseOfState pose_of);
  ~RobotWorld();
  RobotWorld(const RobotWorld&) = delete;
  RobotWorld& operator=(const RobotWorld&) = delete;

  /// Whether the robot can move from state to state; for one state, whether it can be there. ok is false after a
  /// failure.
  [[nodiscard]] PathCheck Check(std::span<const ompl::base::State* const> states, const CheckOptions& check = {}) const;
  /// The distance (m) from the robot's surface to the nearest surface that it must not touch, below 0 inside; at most
  /// max_distance_m of the options (default 3). After a failure: minus infinity.
  [[nodiscard]] double Clearance_m(const ompl::base::State* state) const;

  /// OK, or the first failure.
  [[nodiscard]] Status status() const;
  /// A condition that ends a planner after the first failure. This must outlive it.
  [[nodiscard]] ompl::base::PlannerTerminationCondition EndsOnFailure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::client
