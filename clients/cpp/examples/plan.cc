// SPDX-License-Identifier: BSD-3-Clause
// Plans the path of a robot made of spheres through a mapped apartment. Then moves a sofa into its way, receives the
// change through a watch, and plans again.
//   plan ADDRESS MAP START_X START_Y GOAL_X GOAL_Y
// Prints one line per path: the map's revision, then x, y and yaw of each waypoint.
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/client.h"
#include "dhpmap/ompl/validity.h"

namespace {

namespace dc = dhpmap::client;
namespace ob = ompl::base;
namespace og = ompl::geometric;

using Se2 = ob::SE2StateSpace;

constexpr double kSolve_s = 20;
constexpr unsigned kSeed = 1;
constexpr double kSofa_m = 1.5;  // closer to start or goal the sofa would stand on them
const dc::QueryOptions kOptions{.unknown = dc::Unknown::kFree};

/// A base of two spheres side by side, and a mast: none of it touches the floor.
dc::Spheres Robot() {
  return {.spheres_m = {{{0.08, 0, 0.3}, 0.2}, {{-0.08, 0, 0.3}, 0.2}, {{0, 0, 0.7}, 0.15}}, .may_touch = {}};
}

struct Place {
  double x_m, y_m;
};

/// A path, and the revision of the map for which it was planned.
struct Way {
  std::int64_t revision = 0;
  std::vector<dc::Pose> waypoints;
  std::vector<double> yaw_rad;
};

/// Reports the obstacle at the place, if there is one.
bool IsFree(const dc::Queries& queries, const char* name, const Place& place) {
  const std::vector<dc::Pose> pose{dc::PoseAt({place.x_m, place.y_m, 0})};
  const auto checks = queries.CheckPoses(Robot(), pose, kOptions);
  if (checks.ok() && (*checks)[0].ok) return true;
  const std::string why =
      checks.ok() ? (*checks)[0].contacts.front().contact.object.class_name + " is there" : checks.status().ToString();
  std::cerr << "the robot cannot be at the " << name << ": " << why << "\n";
  return false;
}

/// Uses one state of the map.
std::optional<Way> Plan(const dc::Map& map, const Place& start, const Place& goal) {
  const dc::Result<dc::Pinned> pinned = map.Pin();
  if (!pinned.ok()) return std::cerr << pinned.status().ToString() << "\n", std::nullopt;
  if (!IsFree(*pinned, "start", start) || !IsFree(*pinned, "goal", goal)) return std::nullopt;
  const auto world =
      std::make_shared<dc::RobotWorld>(std::make_shared<dc::Pinned>(*pinned), Robot(), kOptions, dc::PoseOfSe2());
  const auto space = std::make_shared<Se2>();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0);
  bounds.setHigh(0, 11);
  bounds.setHigh(1, 8);
  space->setBounds(bounds);

  og::SimpleSetup setup(space);
  const ob::SpaceInformationPtr information = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<dc::StateValidity>(information, world));
  information->setMotionValidator(std::make_shared<dc::MotionValidity>(information, world));
  setup.setPlanner(std::make_shared<og::RRTConnect>(information));
  ob::ScopedState<Se2> from(space), to(space);
  from->setXY(start.x_m, start.y_m);
  to->setXY(goal.x_m, goal.y_m);
  from->setYaw(0);
  to->setYaw(0);
  setup.setStartAndGoalStates(from, to);

  const auto ends =
      ob::plannerOrTerminationCondition(ob::timedPlannerTerminationCondition(kSolve_s), world->EndsOnFailure());
  if (!setup.solve(ends) || !setup.haveExactSolutionPath()) {
    std::cerr << "no way is found: " << world->status().ToString() << "\n";
    return std::nullopt;
  }
  setup.simplifySolution();
  Way way{pinned->revision(), {}, {}};
  for (const ob::State* state : setup.getSolutionPath().getStates()) {
    way.waypoints.push_back(dc::PoseOfSe2()(state));
    way.yaw_rad.push_back(state->as<Se2::StateType>()->getYaw());
  }
  return way;
}

void Print(const Way& way) {
  std::cout << way.revision;
  for (std::size_t i = 0; i < way.waypoints.size(); ++i) {
    const dc::Vector3& at_m = way.waypoints[i].translation_m;
    std::cout << "  " << at_m.x << " " << at_m.y << " " << way.yaw_rad[i];
  }
  std::cout << std::endl;
}

int Fail(const dc::Status& status) {
  std::cerr << status.ToString() << "\n";
  return EXIT_FAILURE;
}

bool IsNear(const dc::Vector3& at_m, const Place& place) {
  return std::hypot(at_m.x - place.x_m, at_m.y - place.y_m) < kSofa_m;
}

/// Moves the sofa into the middle of a leg of the path, until there is another path.
int BlockAndPlanAgain(const dc::Map& map, const Way& way, const Place& start, const Place& goal) {
  const auto sofas = map.Find("sofa");
  if (!sofas.ok() || sofas->empty() || !sofas->front().box) return std::cerr << "there is no sofa\n", EXIT_FAILURE;
  const dc::Object& sofa = sofas->front();
  const dc::Vector3 from_m = sofa.box->T_map_box.translation_m;
  dc::Watch watch = map.Watch({.objects = {sofa.id}, .after_revision = way.revision});
  for (std::size_t leg = 0; leg + 1 < way.waypoints.size(); ++leg) {
    const dc::Vector3 &a = way.waypoints[leg].translation_m, &b = way.waypoints[leg + 1].translation_m;
    const dc::Vector3 to_m{(a.x + b.x) / 2, (a.y + b.y) / 2, 0};
    if (IsNear(to_m, start) || IsNear(to_m, goal)) continue;
    dc::Edit edit = map.Edit();
    edit.MoveBy(sofa.id, {to_m.x - from_m.x, to_m.y - from_m.y, 0});
    const auto edited = edit.Apply();
    if (!edited.ok()) return Fail(edited.status());

    for (std::int64_t told = 0; told < edited->revision;) {  // received from the watch, as in another client
      const auto change = watch.Next();
      if (!change.ok()) return Fail(change.status());
      told = (*change)->revision;
    }
    std::cerr << sofa.name << " was moved at revision " << edited->revision << "\n";
    const auto check = map.CheckPath(Robot(), way.waypoints, kOptions);
    if (!check.ok()) return Fail(check.status());
    if (!check->ok && check->contacts.front().contact.object.id == sofa.id) {
      if (const auto again = Plan(map, start, goal)) return Print(*again), EXIT_SUCCESS;
    }
    if (const auto undone = map.Undo({.revision = edited->revision}); !undone.ok()) return Fail(undone.status());
  }
  std::cerr << "wherever the sofa is, it is not in the way, or there is no other\n";
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) return std::cerr << "usage: plan ADDRESS MAP START_X START_Y GOAL_X GOAL_Y\n", EXIT_FAILURE;
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  ompl::RNG::setSeed(kSeed);
  const auto connected = dc::Client::Connect(argv[1], {.author = "planner"});
  if (!connected.ok()) return Fail(connected.status());
  const auto map = connected->OpenMap(argv[2]);
  if (!map.ok()) return Fail(map.status());
  const Place start{std::atof(argv[3]), std::atof(argv[4])}, goal{std::atof(argv[5]), std::atof(argv[6])};
  const std::optional<Way> way = Plan(*map, start, goal);
  if (!way) return EXIT_FAILURE;
  Print(*way);
  return BlockAndPlanAgain(*map, *way, start, goal);
}
