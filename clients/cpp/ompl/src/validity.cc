// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/ompl/validity.h"

#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <array>

namespace dhpmap::client {
namespace {

namespace ob = ompl::base;

constexpr double kShortOfContact = 0.01;  // share of the motion

}  // namespace

StateValidity::StateValidity(const ob::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world)
    : ob::StateValidityChecker(space), world_(std::move(world)) {
  specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::EXACT;
}

bool StateValidity::isValid(const ob::State* state) const {
  return si_->satisfiesBounds(state) && world_->Check({&state, 1}).ok;
}

double StateValidity::clearance(const ob::State* state) const { return world_->Clearance_m(state); }

MotionValidity::MotionValidity(const ob::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world)
    : ob::MotionValidator(space), world_(std::move(world)) {}

PathCheck MotionValidity::Check(const ob::State* from, const ob::State* to) const {
  const std::array<const ob::State*, 2> states{from, to};
  return world_->Check(states);
}

bool MotionValidity::checkMotion(const ob::State* from, const ob::State* to) const {
  const bool is_valid = si_->satisfiesBounds(to) && Check(from, to).ok;
  ++(is_valid ? valid_ : invalid_);
  return is_valid;
}

bool MotionValidity::checkMotion(const ob::State* from, const ob::State* to,
                                 std::pair<ob::State*, double>& last_valid) const {
  const PathCheck check = Check(from, to);
  const bool is_valid = check.ok && si_->satisfiesBounds(to);
  ++(is_valid ? valid_ : invalid_);
  if (is_valid) return true;
  const double share = check.contacts.empty() ? 0 : check.contacts[0].place.fraction;
  last_valid.second = check.ok ? 0 : std::max(share - kShortOfContact, 0.0);
  if (last_valid.first != nullptr) {
    si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
  }
  return false;
}

ClearanceObjective::ClearanceObjective(const ob::SpaceInformationPtr& space, std::shared_ptr<const RobotWorld> world,
                                       double wanted_m, double weight)
    : ob::StateCostIntegralObjective(space, /*enableMotionCostInterpolation=*/false),
      world_(std::move(world)),
      wanted_m_(wanted_m),
      weight_(weight) {
  description_ = "Clearance";
}

ob::Cost ClearanceObjective::stateCost(const ob::State* state) const {
  const double lacks_m = std::max(wanted_m_ - world_->Clearance_m(state), 0.0);
  return ob::Cost(1 + weight_ * std::min(lacks_m / wanted_m_, 1.0));
}

}  // namespace dhpmap::client
