// SPDX-License-Identifier: BSD-3-Clause
// Planning in the sample apartment: what OMPL is told is true by brute force against the mesh.
#include <gtest/gtest.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "dhpmap/client.h"
#include "dhpmap/ompl/validity.h"
#include "tests/e2e/server_process.h"
#include "tests/support/client.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/cpp/ompl/mesh_distance.h"

namespace dhpmap::testing {
namespace {

namespace ob = ompl::base;
using Se2 = ob::SE2StateSpace;

constexpr double kReach_m = 0.6;    // of brute force
constexpr double kSlack_m = 0.002;  // meshes are in floats; what moves is looked at in steps
constexpr double kStep_m = 0.03;

/// That of the example.
const client::Spheres kRobot{.spheres_m = {{{0.08, 0, 0.3}, 0.2}, {{-0.08, 0, 0.3}, 0.2}, {{0, 0, 0.7}, 0.15}},
                             .may_touch = {}};
const client::QueryOptions kOptions{.unknown = client::Unknown::kFree};

struct Se2Pose {
  double x_m, y_m, yaw_rad;
};

/// Where a robot is at a share of the way, by the shorter turn.
Se2Pose Between(const Se2Pose& a, const Se2Pose& b, double share) {
  const double turn = std::remainder(b.yaw_rad - a.yaw_rad, 2 * M_PI);
  return {a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
          std::remainder(a.yaw_rad + share * turn, 2 * M_PI)};
}

/// From the robot's surface to the mesh.
double BruteClearance_m(const Se2Pose& at, const std::vector<Triangle>& triangles) {
  double least_m = kReach_m;
  for (const client::Sphere& sphere : kRobot.spheres_m) {
    const client::Vector3& c = sphere.center_m;
    const Eigen::Vector3d p(at.x_m + std::cos(at.yaw_rad) * c.x - std::sin(at.yaw_rad) * c.y,
                            at.y_m + std::sin(at.yaw_rad) * c.x + std::cos(at.yaw_rad) * c.y, c.z);
    least_m = std::min(least_m, DistanceToMesh(p, triangles, kReach_m + sphere.radius_m) - sphere.radius_m);
  }
  return least_m;
}

/// Those that may be within reach of a robot between the two.
std::vector<Triangle> Around(const Se2Pose& a, const Se2Pose& b, const std::vector<Triangle>& triangles) {
  constexpr double kMargin_m = kReach_m + 0.5;  // of the robot itself, and a side of a triangle
  const auto is_far = [](double low, double high, double value) {
    return value < low - kMargin_m || value > high + kMargin_m;
  };
  std::vector<Triangle> near;
  for (const Triangle& t : triangles) {
    if (is_far(std::min(a.x_m, b.x_m), std::max(a.x_m, b.x_m), t[0].x())) continue;
    if (is_far(std::min(a.y_m, b.y_m), std::max(a.y_m, b.y_m), t[0].y())) continue;
    near.push_back(t);
  }
  return near;
}

/// On all the way, in steps.
double BruteClearance_m(const Se2Pose& a, const Se2Pose& b, const std::vector<Triangle>& all) {
  const std::vector<Triangle> triangles = Around(a, b, all);
  const int num_steps = 1 + static_cast<int>(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / kStep_m);
  double least_m = kReach_m;
  for (int i = 0; i <= num_steps; ++i) {
    least_m = std::min(least_m, BruteClearance_m(Between(a, b, static_cast<double>(i) / num_steps), triangles));
  }
  return least_m;
}

/// The sample apartment, mapped by dhpmap-server: once for all tests.
class ClientPlan : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    dir_ = std::make_unique<TempDir>();
    const std::string data = (dir_->path() / "apartment").string();
    ASSERT_EQ(RunProgram(dir_->path(), {Program("dhpmap-simulate"), data, "--frames", "60", "--width", "160",
                                        "--height", "120", "--quiet"})
                  .exit_code,
              0);
    server_ = std::make_unique<ServerProcess>(dir_->path(), dir_->path() / "maps.db");
    ASSERT_TRUE(server_->is_serving());
    const Outcome mapped = server_->Dhpmap({"map", data, "--map", "apartment"});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  }
  static void TearDownTestSuite() {
    server_.reset();
    dir_.reset();
  }

  /// All objects that are present, at a revision.
  static std::vector<Triangle> MeshAt(std::int64_t revision) {
    v1::GetSubmapMeshRequest request;
    request.set_name("maps/apartment");
    request.set_read_revision(revision);
    std::string ply;
    for (const auto& part : Client(server_->Connect()).Call(&SubmapStub::GetSubmapMesh, request).value()) {
      ply += part.data();
    }
    std::vector<Triangle> triangles = TrianglesOf(ply);
    std::erase_if(triangles, [](const Triangle& t) {  // above the robot and all that is within reach
      return std::min({t[0].z(), t[1].z(), t[2].z()}) > 0.85 + kReach_m;
    });
    EXPECT_GT(triangles.size(), 10000);
    return triangles;
  }
  static client::Map OpenApartment() {
    const auto connected = client::Client::Connect(server_->grpc_address());
    EXPECT_OK(connected);
    auto map = connected->OpenMap("apartment");
    EXPECT_OK(map);
    return *std::move(map);
  }

  struct Space {
    ob::SpaceInformationPtr information;
    std::shared_ptr<client::RobotWorld> world;

    [[nodiscard]] ob::ScopedState<Se2> State(const Se2Pose& at) const {
      ob::ScopedState<Se2> state(information);
      state->setXY(at.x_m, at.y_m);
      state->setYaw(at.yaw_rad);
      return state;
    }
  };
  static Space SpaceOf(const client::Map& map, client::QueryOptions options = kOptions) {
    const auto se2 = std::make_shared<Se2>();
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0);
    bounds.setHigh(11);
    se2->setBounds(bounds);
    Space space{std::make_shared<ob::SpaceInformation>(se2),
                std::make_shared<client::RobotWorld>(std::make_shared<client::Loop>(map.Loop()), kRobot, options,
                                                     client::PoseOfSe2())};
    space.information->setStateValidityChecker(std::make_shared<client::StateValidity>(space.information, space.world));
    space.information->setMotionValidator(std::make_shared<client::MotionValidity>(space.information, space.world));
    space.information->setup();
    return space;
  }
  static std::vector<Se2Pose> RandomPoses(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(0, 1);
    std::vector<Se2Pose> poses;
    for (int i = 0; i < count; ++i) poses.push_back(Se2Pose{11 * u(random), 8 * u(random), 6 * u(random) - 3});
    return poses;
  }

  inline static std::unique_ptr<TempDir> dir_;
  inline static std::unique_ptr<ServerProcess> server_;
};

TEST_F(ClientPlan, StatesAreValidAndClearAsBruteForceSays) {
  const client::Map map = OpenApartment();
  const std::vector<Triangle> triangles = MeshAt(map.Info()->revision);
  const Space space = SpaceOf(map);
  const auto& checker = *space.information->getStateValidityChecker();
  int num_valid = 0, num_touching = 0;
  for (const Se2Pose& at : RandomPoses(80, 3)) {
    const auto state = space.State(at);
    const double brute_m = BruteClearance_m(at, triangles);
    if (checker.isValid(state.get())) {
      ++num_valid;
      EXPECT_GE(brute_m, -kSlack_m) << at.x_m << " " << at.y_m;
      EXPECT_NEAR(std::min(checker.clearance(state.get()), kReach_m), brute_m, kSlack_m);
    } else if (brute_m < -kSlack_m) {
      ++num_touching;  // others are inside of something
    }
  }
  EXPECT_GT(num_valid, 10);
  EXPECT_GT(num_touching, 10);
  ASSERT_OK(space.world->status());
}

TEST_F(ClientPlan, MotionsAreValidAsBruteForceSaysAndTheLastValidStateIs) {
  const client::Map map = OpenApartment();
  const std::vector<Triangle> triangles = MeshAt(map.Info()->revision);
  const Space space = SpaceOf(map);
  const auto& validator = *space.information->getMotionValidator();
  std::vector<Se2Pose> valid;
  for (const Se2Pose& at : RandomPoses(120, 5)) {
    if (space.information->isValid(space.State(at).get())) valid.push_back(at);
  }
  int num_valid = 0, num_crossing = 0;
  for (std::size_t i = 0; i + 1 < valid.size(); ++i) {
    const Se2Pose &a = valid[i], b = Between(a, valid[i + 1], 0.3);
    const auto from = space.State(a), to = space.State(b);
    const double brute_m = BruteClearance_m(a, b, triangles);
    if (validator.checkMotion(from.get(), to.get())) {
      ++num_valid;
      EXPECT_GE(brute_m, -kSlack_m) << a.x_m << " " << a.y_m << " to " << b.x_m << " " << b.y_m;
      continue;
    }
    if (space.information->isValid(to.get())) ++num_crossing;
    ob::ScopedState<Se2> last(space.information);
    std::pair<ob::State*, double> last_valid(last.get(), 1.0);
    EXPECT_FALSE(validator.checkMotion(from.get(), to.get(), last_valid));
    EXPECT_LT(last_valid.second, 1);
    EXPECT_TRUE(space.information->isValid(last.get()));
    EXPECT_TRUE(validator.checkMotion(from.get(), last.get()));
  }
  EXPECT_GT(num_valid, 5);
  EXPECT_GT(num_crossing, 2) << "both ends are valid, and what is between them is not";
}

TEST_F(ClientPlan, ClearerPathsCostLess) {
  const client::Map map = OpenApartment();
  const Space space = SpaceOf(map);
  const client::ClearanceObjective objective(space.information, space.world, 0.5, 10);
  double last_cost = 0, last_m = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, double>> by_clearance;
  for (const Se2Pose& at : RandomPoses(40, 9)) {
    const auto state = space.State(at);
    by_clearance.emplace_back(space.world->Clearance_m(state.get()), objective.stateCost(state.get()).value());
  }
  std::sort(by_clearance.rbegin(), by_clearance.rend());
  for (const auto& [clearance_m, cost] : by_clearance) {
    EXPECT_LE(clearance_m, last_m);
    EXPECT_GE(cost, last_cost);
    EXPECT_NEAR(cost, 1 + 10 * std::clamp((0.5 - clearance_m) / 0.5, 0.0, 1.0), 1e-9);
    last_cost = cost, last_m = clearance_m;
  }
}

/// A line of the example: the revision, and the way through that state of the map.
struct Line {
  std::int64_t revision = 0;
  std::vector<Se2Pose> way;
};

std::vector<Line> LinesOf(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (std::string one; std::getline(in, one);) {
    std::istringstream numbers(one);
    Line& line = lines.emplace_back();
    numbers >> line.revision;
    for (Se2Pose at{}; numbers >> at.x_m >> at.y_m >> at.yaw_rad;) line.way.push_back(at);
  }
  return lines;
}

std::vector<client::Pose> PosesOf(const Line& line) {
  std::vector<client::Pose> poses;
  for (const Se2Pose& at : line.way) poses.push_back(client::PoseAt({at.x_m, at.y_m, 0}, at.yaw_rad));
  return poses;
}

TEST_F(ClientPlan, TheExampleFindsAWayAndAnotherOneOnceASofaIsInIt) {
  const Outcome planned = RunProgram(
      dir_->path(), {Program("dhpmap-plan-example"), server_->grpc_address(), "apartment", "5.2", "2.6", "8", "6"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  const std::vector<Line> lines = LinesOf(planned.out);
  ASSERT_EQ(lines.size(), 2) << planned.out;
  const client::Map map = OpenApartment();
  for (const Line& line : lines) {
    ASSERT_GE(line.way.size(), 2);
    EXPECT_NEAR(line.way.front().x_m, 5.2, 1e-6);
    EXPECT_NEAR(line.way.back().y_m, 6, 1e-6);
    ASSERT_OK_AND_ASSIGN(const auto check, map.At(line.revision).CheckPath(kRobot, PosesOf(line), kOptions));
    EXPECT_TRUE(check.ok) << planned.out;
    const std::vector<Triangle> triangles = MeshAt(line.revision);
    for (std::size_t i = 0; i + 1 < line.way.size(); ++i) {
      EXPECT_GE(BruteClearance_m(line.way[i], line.way[i + 1], triangles), -kSlack_m) << "leg " << i;
    }
  }
  ASSERT_OK_AND_ASSIGN(const auto old_way, map.CheckPath(kRobot, PosesOf(lines[0]), kOptions));
  ASSERT_FALSE(old_way.ok);
  EXPECT_EQ(old_way.contacts[0].contact.object.class_name, "sofa");
  ASSERT_OK(map.Undo({.author = "planner"}));
}

TEST_F(ClientPlan, ALostServerEndsPlanningAndIsTold) {
  ServerProcess own(dir_->path(), dir_->path() / "own.db");
  const auto connected = client::Client::Connect(own.grpc_address());
  ASSERT_OK(connected);
  ASSERT_OK_AND_ASSIGN(const client::Map map, connected->CreateMap("empty"));
  const Space space = SpaceOf(map, {.unknown = client::Unknown::kFree, .deadline_s = 0.2});
  const auto at = space.State({1, 1, 0});
  EXPECT_TRUE(space.information->isValid(at.get()));
  const auto ends = space.world->EndsOnFailure();
  EXPECT_FALSE(ends());
  own.process().Signal(SIGKILL);
  ASSERT_TRUE(own.process().Wait().has_value());
  EXPECT_FALSE(space.information->isValid(at.get()));
  EXPECT_TRUE(ends());
  EXPECT_FALSE(space.world->status().ok());
}

}  // namespace
}  // namespace dhpmap::testing
