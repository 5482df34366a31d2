// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>

#include <memory>
#include <utility>

#include "dhpmap/ompl/robot_world.h"

namespace dhpmap::client {

/// A state is valid where the robot touches nothing. One query a state.
class StateValidity final : public ompl::base::StateValidityChecker {
 public:
  StateValidity(const ompl::base::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world);

  bool isValid(const ompl::base::State* state) const override;
  /// See RobotWorld::Clearance_m.
  double clearance(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const RobotWorld> world_;
};

/// A motion is valid if the robot touches nothing on all its way, whatever its length: nothing between samples is
/// missed. One query a motion. Right for spaces in which the robot moves evenly between two states, turning about one
/// axis, such as SE2 and SE3. The first state is looked at, too.
class MotionValidity final : public ompl::base::MotionValidator {
 public:
  MotionValidity(const ompl::base::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world);

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// last_valid: the state just before the first contact, and its share of the way.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  PathCheck Check(const ompl::base::State* from, const ompl::base::State* to) const;

  std::shared_ptr<const RobotWorld> world_;
};

/// Paths that keep wanted_m of clearance cost their length, others more: up to 1 + weight times where they touch. Two
/// queries a motion.
class ClearanceObjective final : public ompl::base::StateCostIntegralObjective {
 public:
  ClearanceObjective(const ompl::base::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world,
                     double wanted_m, double weight = 10);

  ompl::base::Cost stateCost(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const RobotWorld> world_;
  double wanted_m_, weight_;
};

}  // namespace dhpmap::client
