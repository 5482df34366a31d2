// SPDX-License-Identifier: BSD-3-Clause
// How near motions come to surfaces, against all triangles at very many moments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mapping/query/trajectory_query.h"
#include "tests/unit/mapping/query/knots.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kIgnoringUnknown;
using testing::kSceneVoxel_m;
using testing::SurfacesOf;

constexpr double kClearRounding_m = 2e-5, kClearTolerance_m = ClearanceQuery::kTolerance_m + kClearRounding_m;
constexpr SubmapId kBall(1), kBlock(2), kSmall(3);

/// Three things with space between them.
Map ThreeThings() {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map, ClassId(1)), testing::Ball({0.8, 0, 0}, 0.25),
                       testing::CubeAt({0.8, 0, 0}, 0.5));
  testing::ObserveBand(testing::AddThing(map, ClassId(2)), testing::Block({-0.7, 0, 0}, {0.2, 0.3, 0.1}),
                       testing::CubeAt({-0.7, 0, 0}, 0.5));
  testing::ObserveBand(testing::AddThing(map, ClassId(1)), testing::Ball({0, 0.8, 0.1}, 0.15),
                       testing::CubeAt({0, 0.8, 0.1}, 0.4));
  std::mt19937 random(8);
  map.FindMutable(kBlock)->mutable_info().T_map_submap = testing::RandomPose(random, 0.1);
  map.Publish(0);
  return map;
}

/// The distance to what is nearest of all triangles, less padding.
class AllSurfaces {
 public:
  AllSurfaces(const Map& map, const QueryScope& scope) {
    for (const auto& submap : map.published()->submaps()) {
      const SubmapInfo& info = submap->info();
      const auto& touchable = scope.may_touch;
      if (std::find(touchable.begin(), touchable.end(), info.id) != touchable.end() || !scope.Holds(info)) continue;
      const auto is_it = [&info](const SubmapInfo& other) { return other.id == info.id; };
      parts_.push_back({info.id, scope.padding.Of(info), testing::AllTriangles(*map.published(), is_it)});
    }
  }
  [[nodiscard]] double Distance(const Eigen::Vector3d& p, SubmapId* whose = nullptr) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const Part& part : parts_) {
      const double distance_m = part.triangles.Nearest(p).distance_m - part.padding_m;
      if (distance_m < least_m && whose != nullptr) *whose = part.id;
      least_m = std::min(least_m, distance_m);
    }
    return least_m;
  }

 private:
  struct Part {
    SubmapId id;
    double padding_m;
    testing::AllTriangles triangles;
  };
  std::vector<Part> parts_;
};

using Way = std::vector<SphereKnot>;

Way RandomWay(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Way knots;
  Eigen::Vector3d p = Eigen::Vector3d{unit(random), unit(random), unit(random)};
  for (int h = 0; h < 4; ++h) {
    knots.push_back({static_cast<double>(h), p, 0.06 + 0.05 * unit(random)});
    p += 0.5 * Eigen::Vector3d{unit(random), unit(random), unit(random)};
  }
  return knots;
}

void ExpectLeast(const Way& knots, const LeastClearance& least, const AllSurfaces& all) {
  const SphereKnot nearest = testing::KnotAt(knots, least.at);
  SubmapId whose;
  EXPECT_NEAR(all.Distance(nearest.center_m, &whose) - nearest.radius_m, least.distance_m, kClearRounding_m)
      << least.at;
  ASSERT_NE(least.submap, nullptr);
  EXPECT_EQ(least.submap->id, whose);
  constexpr int kMoments = 250;
  for (int i = 0; i <= kMoments; ++i) {
    const SphereKnot knot = testing::KnotAt(knots, static_cast<double>(knots.size() - 1) * i / kMoments);
    EXPECT_GE(all.Distance(knot.center_m) - knot.radius_m, least.distance_m - kClearTolerance_m) << knot.at;
  }
  // And as many around it.
  for (int i = -50; i <= 50; ++i) {
    const SphereKnot knot =
        testing::KnotAt(knots, std::clamp(least.at + 4e-4 * i, 0.0, static_cast<double>(knots.size() - 1)));
    EXPECT_GE(all.Distance(knot.center_m) - knot.radius_m, least.distance_m - kClearTolerance_m) << knot.at;
  }
}

TEST(ClearanceQuery, IsReachedAtItsMomentAndAtNoOtherIsAnythingNearer) {
  Map map = ThreeThings();
  const auto surfaces = SurfacesOf(map);
  std::mt19937 random(6);
  BodyOptions options[3] = {kIgnoringUnknown, kIgnoringUnknown, kIgnoringUnknown};
  options[1].scope.padding = {.default_m = 0.02, .classes = {{ClassId(2), 0.15}}, .submaps = {{kSmall, 0}}};
  options[2].scope.may_touch = {kBall};
  int num_within = 0, num_clear = 0;
  for (const BodyOptions& o : options) {
    const AllSurfaces all(map, o.scope);
    const ClearanceQuery query(surfaces, o);
    for (int round = 0; round < 8; ++round) {
      const Way knots = RandomWay(random);
      LeastClearance least{.distance_m = o.max_distance_m};
      EXPECT_TRUE(query.Lower(knots, least));
      ExpectLeast(knots, least, all);
      ++(least.distance_m < 0 ? num_within : num_clear);
    }
  }
  EXPECT_GT(num_within, 2);
  EXPECT_GT(num_clear, 10);
}

TEST(ClearanceQuery, TellsNothingThatIsFartherThanAsked) {
  Map map = ThreeThings();
  const auto surfaces = SurfacesOf(map);
  const Way knots = {{0, {0.8, 0, 1.0}, 0.1}, {1, {0.9, 0, 1.0}, 0.1}};  // 0.65 m above the ball
  BodyOptions options = kIgnoringUnknown;
  for (const double most_m : {0.6, 0.7}) {
    options.max_distance_m = most_m;
    LeastClearance least{.distance_m = most_m};
    EXPECT_EQ(ClearanceQuery(surfaces, options).Lower(knots, least), most_m > 0.65);
    EXPECT_EQ(least.submap != nullptr, most_m > 0.65);
  }
  LeastClearance nearer{.distance_m = 0.5};
  EXPECT_FALSE(ClearanceQuery(surfaces, options).Lower(knots, nearer)) << "something else is nearer already";
  EXPECT_EQ(nearer.submap, nullptr);
  EXPECT_EQ(nearer.distance_m, 0.5);
  LeastClearance none{.distance_m = 3};
  EXPECT_FALSE(ClearanceQuery(surfaces, options).Lower({}, none));
}

TEST(ClearanceQuery, LooksRarelyWhereSurfacesAreFar) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), [](const Eigen::Vector3d& p) { return p.z(); },
                       {Eigen::Vector3d(-3, -3, -0.3), Eigen::Vector3d(3, 3, 0.3)});
  const Way along = {{0, {-2, 0.01, 1}, 0.1}, {1, {2, 0.02, 1}, 0.1}};  // as near all the way
  LeastClearance least{.distance_m = 3};
  WorkBudget work;
  EXPECT_TRUE(ClearanceQuery(SurfacesOf(map), kIgnoringUnknown).Lower(along, least, {}, &work));
  EXPECT_NEAR(least.distance_m, 0.9, 1e-3);
  EXPECT_LT(work.spent(), 64 * 400) << "4 m by what a millimetre would need is 4,000 looks";
}

TEST(ClearanceQuery, LooksAtNothingForSomebodyWhoIsGone) {
  Map map = ThreeThings();
  std::mt19937 random(6);
  const Way knots = RandomWay(random);
  const ClearanceQuery query(SurfacesOf(map), kIgnoringUnknown);
  std::stop_source caller;
  WorkBudget work;
  LeastClearance least{.distance_m = 3};
  EXPECT_TRUE(query.Lower(knots, least, caller.get_token(), &work));
  const std::int64_t spent = work.spent();
  EXPECT_GT(spent, 0);
  caller.request_stop();
  LeastClearance none{.distance_m = 3};
  EXPECT_FALSE(query.Lower(knots, none, caller.get_token(), &work));
  EXPECT_EQ(work.spent(), spent);
}

TrajectoryAnswer Ask(Map& map, TrajectoryOptions options, const RobotMotion& motion) {
  options.with_clearance = true;
  const auto query = TrajectoryQuery::Make(SurfacesOf(map), std::move(options));
  EXPECT_TRUE(query.ok());
  auto answer = query->Check(motion);
  EXPECT_TRUE(answer.ok());
  return *std::move(answer);
}

TEST(TrajectoryClearance, IsThatOfTheNearestSphereAndBelowZeroIfTheMotionIsNotValid) {
  Map map = ThreeThings();
  const AllSurfaces all(map, {});
  std::mt19937 random(12);
  int num_valid = 0, num_second = 0;
  for (int round = 0; round < 40; ++round) {
    RobotMotion motion;
    motion.spheres = {RandomWay(random), RandomWay(random)};
    const TrajectoryAnswer answer = Ask(map, {.bodies = kIgnoringUnknown}, motion);
    ASSERT_TRUE(answer.clearance);
    const LeastClearance& least = answer.clearance->least;
    if (answer.is_valid) EXPECT_GT(least.distance_m, -1e-5);
    else EXPECT_LT(least.distance_m, kClearTolerance_m);
    num_valid += answer.is_valid;
    num_second += answer.clearance->sphere == 1u;
    if (!answer.is_valid || round >= 12) continue;
    for (const Way& way : motion.spheres) {
      for (double at = 0; at <= 3; at += 0.02) {
        EXPECT_GE(all.Distance(testing::KnotAt(way, at).center_m) - testing::KnotAt(way, at).radius_m,
                  least.distance_m - kClearTolerance_m);
      }
    }
    const SphereKnot nearest = testing::KnotAt(motion.spheres.at(answer.clearance->sphere.value()), least.at);
    EXPECT_NEAR(all.Distance(nearest.center_m) - nearest.radius_m, least.distance_m, kClearRounding_m);
  }
  EXPECT_GT(num_valid, 10);
  EXPECT_LT(num_valid, 35);
  EXPECT_GT(num_second, 5);
}

Transform Turned(double x, double y, double turn_rad) {
  Transform T = Transform::Identity();
  T.translate(Eigen::Vector3d(x, y, 0));
  T.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()));
  return T;
}

TEST(TrajectoryClearance, OfARobotThatTurnsIsNoLargerAndSmallerByTwoMillimetresAtMost) {
  Map map = ThreeThings();
  const AllSurfaces all(map, {});
  RobotMotion motion;
  motion.robot = {{{0, 0, 0.3}, 0.05}, {{0.45, 0.1, 0.05}, 0.04}};
  motion.waypoints = {Turned(0.1, -0.5, 0.3), Turned(0.1, -0.2, 1.6), Turned(0, -0.3, 2.4)};
  const TrajectoryAnswer answer = Ask(map, {.bodies = kIgnoringUnknown}, motion);
  double least_m = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 400;
  for (std::size_t h = 0; h < 2; ++h) {
    const Transform &from = motion.waypoints[h], &to = motion.waypoints[h + 1];
    const Eigen::Quaterniond a(from.linear()), b(to.linear());
    for (int i = 0; i <= kSteps; ++i) {
      const double share = i * 1.0 / kSteps;
      for (const AttachedShape::Ball& ball : motion.robot) {
        const Eigen::Vector3d p =
            from.translation() + share * (to.translation() - from.translation()) + a.slerp(share, b) * ball.center_m;
        least_m = std::min(least_m, all.Distance(p) - ball.radius_m);
      }
    }
  }
  ASSERT_TRUE(answer.clearance);
  EXPECT_LE(answer.clearance->least.distance_m, least_m + kClearTolerance_m);
  EXPECT_GE(answer.clearance->least.distance_m, least_m - 2e-3);
  EXPECT_GT(least_m, 0.01);
}

TEST(TrajectoryClearance, OfWhatIsCarriedIsSmallerByHalfAVoxelsDiagonalAtMost) {
  Map map = ThreeThings();
  TrajectoryOptions options{.bodies = kIgnoringUnknown, .attached = {{kSmall, {kBall}}}};
  options.bodies.scope.attached = {kSmall};
  const std::vector<Transform> poses = {Turned(0, 0, 0), Turned(-0.2, -0.35, 0)};  // towards the block
  RobotMotion motion;
  motion.attached = {poses};
  motion.waypoints = poses;
  const TrajectoryAnswer answer = Ask(map, options, motion);
  QueryScope scope = options.bodies.scope;
  scope.may_touch = {kBall};
  const AllSurfaces all(map, scope);
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& triangle : testing::TrianglesInMap(*map.published()->Find(kSmall))) {
    for (int i = 0; i <= 10; ++i) {
      least_m = std::min(least_m, all.Distance(triangle[0] + 0.1 * i * poses[1].translation()));
    }
  }
  ASSERT_TRUE(answer.clearance);
  EXPECT_EQ(answer.clearance->attached, 0u);
  EXPECT_FALSE(answer.clearance->sphere);
  EXPECT_EQ(answer.clearance->least.submap->id, kBlock);
  EXPECT_LE(answer.clearance->least.distance_m, least_m + kClearTolerance_m);
  EXPECT_GE(answer.clearance->least.distance_m, least_m - std::sqrt(3.0) * kSceneVoxel_m)
      << "a triangle lies in a voxel";
  EXPECT_GT(least_m, 0.1);
}

TEST(TrajectoryClearance, WhatMayBeTouchedDoesNotCountAndEachSphereHasItsOwn) {
  Map map = ThreeThings();
  TrajectoryOptions options{.bodies = kIgnoringUnknown};
  options.spheres.lists = {{}, {kBall}};
  options.spheres.list_of = {1, 0};
  RobotMotion motion;
  motion.spheres = {{{0, {0.8, 0, 0.2}, 0.1}}, {{0, {0.8, 0, 0.7}, 0.1}}};  // the first is in the ball
  const TrajectoryAnswer answer = Ask(map, options, motion);
  EXPECT_TRUE(answer.is_valid);
  ASSERT_TRUE(answer.clearance);
  EXPECT_EQ(answer.clearance->sphere, 1u);
  EXPECT_NEAR(answer.clearance->least.distance_m, 0.35, 0.1 * kSceneVoxel_m);
  options.spheres.lists = {{kBall, kBlock, kSmall}};
  options.spheres.list_of.clear();
  EXPECT_FALSE(Ask(map, options, motion).clearance) << "there is nothing else";
}

TEST(TrajectoryClearance, OfWhoStartsInsideAnObjectIsHowDeepThatIs) {
  Map map = ThreeThings();
  RobotMotion motion;
  motion.spheres = {{{0, {0.8, 0, 0}, 0.02}, {1, {0.82, 0, 0}, 0.02}}};
  const TrajectoryAnswer answer = Ask(map, {.bodies = kIgnoringUnknown}, motion);
  EXPECT_FALSE(answer.is_valid);
  ASSERT_TRUE(answer.clearance);
  EXPECT_NEAR(answer.clearance->least.distance_m, -0.27, 0.1 * kSceneVoxel_m);
  EXPECT_EQ(answer.clearance->least.at, 0);
}

TEST(TrajectoryClearance, CostsWorkAndIsGivenUpWithIt) {
  Map map = ThreeThings();
  const auto surfaces = SurfacesOf(map);
  RobotMotion motion;
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) motion.spheres.push_back(RandomWay(random));
  const auto spent = [&](bool with_clearance, std::int64_t most, bool& is_ok) {
    const auto query =
        TrajectoryQuery::Make(surfaces, {.bodies = kIgnoringUnknown, .attached = {}, .with_clearance = with_clearance});
    WorkBudget work(most);
    const auto answer = query->Check(motion, {}, &work);
    is_ok = answer.ok();
    EXPECT_EQ(is_ok, !work.is_over());
    return work.spent();
  };
  constexpr std::int64_t kPlentyOfWork = 1'000'000'000;
  bool is_ok = false;
  const std::int64_t without = spent(false, kPlentyOfWork, is_ok);
  EXPECT_TRUE(is_ok);
  const std::int64_t with = spent(true, kPlentyOfWork, is_ok);
  EXPECT_TRUE(is_ok);
  ASSERT_GT(with, without + 10'000);
  const std::int64_t stopped = spent(true, (with + without) / 2, is_ok);
  EXPECT_FALSE(is_ok);
  EXPECT_LT(stopped, (with + without) / 2 + 10'000);
}

}  // namespace
}  // namespace dhpmap
