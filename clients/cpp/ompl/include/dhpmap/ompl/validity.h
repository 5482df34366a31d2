// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>

#include <memory>
#include <utility>

#include "dhpmap/ompl/robot_world.h"

namespace dhpmap::client {

/// A state is valid if the robot touches nothing. One query per state.
class StateValidity final : public ompl::base::StateValidityChecker {
 public:
  StateValidity(const ompl::base::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world);

  bool isValid(const ompl::base::State* state) const override;
  /// See RobotWorld::Clearance_m.
  double clearance(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const RobotWorld> world_;
};

/// A motion is valid if the robot touches nothing on the whole motion, of any length: it is checked continuously, not
/// by samples. One query per motion. Correct for spaces in which the robot moves evenly between two states and rotates
/// about one axis, such as SE2 and SE3. Checks the first state, too.
class MotionValidity final : public ompl::base::MotionValidator {
 public:
  MotionValidity(const ompl::base::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world);

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// last_valid: the state just before the first contact, and its share of the motion.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  PathCheck Check(const ompl::base::State* from, const ompl::base::State* to) const;

  std::shared_ptr<const RobotWorld> world_;
};

/// The cost of a path is its length where its clearance is at least wanted_m. With less clearance the cost grows, up to
/// (1 + weight) times the length at a contact. Two queries per motion.
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
