// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/body_check.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "server/app/queries/trajectory_check.h"
#include "tests/unit/mapping/query/stopped_work.h"
#include "tests/unit/server/app/plane_map.h"

namespace dhpmap {
namespace {

using testing::PlaneMap;

/// In a shifted and turned frame; unobserved space counts as free.
CheckQuestion Turned() {
  CheckQuestion question;
  question.options.unknown = UnknownSpace::kFree;
  question.T_map_query.translate(Eigen::Vector3d(1, 2, 3));
  question.T_map_query.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 1).normalized()));
  return question;
}

TEST(CheckBodies, AnswersInTheQueryFrame) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  CheckQuestion question = Turned();
  const Transform T_query_map = question.T_map_query.inverse();
  const Eigen::Vector3d p = T_query_map * Eigen::Vector3d(0.1, 0.1, 0.3);
  OrientedBox box{T_query_map, {0.05, 0.05, 0.15}};
  box.T_world_box.translate(Eigen::Vector3d(0.1, 0.1, 0.3));
  const std::vector<Body> bodies = {Capsule{p, p, 0.15}, Capsule{p, p, 0.05}, box};
  std::vector<BodyAnswer> answers;
  ASSERT_TRUE(CheckBodies(view, cache, question, bodies, {}, [&](const BodyAnswer& a) { answers.push_back(a); }).ok());
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_FALSE(answers[1].is_colliding);
  for (const std::size_t i : {0u, 2u}) {
    ASSERT_EQ(answers[i].contacts.size(), 1u) << i;
    const BodyContact& contact = answers[i].contacts[0];
    EXPECT_NEAR(contact.depth_m, 0.05, 1e-3);
    EXPECT_NEAR((question.T_map_query * contact.point_m).z(), 0.2, 1e-3);
    EXPECT_NEAR((contact.normal - T_query_map.linear() * Eigen::Vector3d::UnitZ()).norm(), 0, 1e-3);
  }
  question.max_contacts = 0;
  ASSERT_TRUE(CheckBodies(view, cache, question, bodies, {}, [&](const BodyAnswer& a) {
                EXPECT_TRUE(a.contacts.empty());
              }).ok());
}

TEST(CheckTrajectories, AnswerInTheQueryFrame) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  const CheckQuestion question = Turned();
  const Transform T_query_map = question.T_map_query.inverse();
  const auto motion_of = [&](std::size_t number) {
    RobotMotion motion;
    const auto knot = [&](double at, double z_m) {
      return SphereKnot{at, T_query_map * Eigen::Vector3d(0.1, 0.1, z_m), 0.05};
    };
    if (number == 0) {
      motion.spheres = {{knot(0, 0.5), knot(1, 0)}};
    } else {
      motion.robot = {{{0, 0, 0}, 0.05}};
      Transform T = T_query_map;
      T.translate(Eigen::Vector3d(0.1, 0.1, number == 1 ? 0.5 : 0.22));
      motion.waypoints = {T};
    }
    return motion;
  };
  std::vector<TrajectoryAnswer> answers;
  ASSERT_TRUE(CheckTrajectories(view, cache, question, 3, motion_of, {}, [&](const TrajectoryAnswer& a) {
                answers.push_back(a);
              }).ok());
  ASSERT_EQ(answers.size(), 3u);
  ASSERT_EQ(answers[0].contacts.size(), 1u);
  EXPECT_NEAR(answers[0].contacts[0].at, 0.5, 2e-3);
  EXPECT_NEAR((question.T_map_query * answers[0].contacts[0].contact.point_m).z(), 0.2, 1e-3);
  EXPECT_TRUE(answers[1].is_valid);
  EXPECT_FALSE(answers[2].is_valid);
}

TEST(CheckBodies, EndsSoonAfterACancellation) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  const std::vector<Body> bodies(5000, Capsule{{0.1, 0.1, 0.3}, {0.1, 0.1, 0.3}, 0.15});
  std::stop_source caller;
  int num_answered = 0;
  const Status status = CheckBodies(view, cache, {}, bodies, caller.get_token(), [&](const BodyAnswer&) {
    if (++num_answered == 100) caller.request_stop();
  });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_EQ(num_answered, 100);
}

// Checks in pieces, and the limit of their cost.

constexpr std::size_t kRoomForSheet = std::size_t{1} << 30;

const std::shared_ptr<const MapSnapshot>& SmallSheet() {
  static const std::shared_ptr<const MapSnapshot> sheet = testing::SheetMap(2, 2, 3);
  return sheet;
}

/// Every second body touches the sheet: small boxes and spheres, and one box around all of it.
std::vector<Body> SomeBodies() {
  std::vector<Body> bodies;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d p(0.1 + 0.1 * i, 0.2 + 0.05 * i, i % 2 == 0 ? 0.0 : 0.9);
    if (i % 3 == 0) bodies.emplace_back(Capsule{p, p, 0.2});
    else bodies.emplace_back(OrientedBox{Transform(Eigen::Translation3d(p)), {0.2, 0.2, 0.2}});
  }
  bodies.emplace_back(OrientedBox{Transform(Eigen::Translation3d(2, 2, 0)), {5, 5, 5}});
  return bodies;
}

CheckQuestion Heedless() {
  CheckQuestion question;
  question.options.unknown = UnknownSpace::kFree;
  question.max_contacts = 3;
  return question;
}

void ExpectSameAnswer(const BodyAnswer& expected, const BodyAnswer& answer) {
  EXPECT_EQ(answer.is_colliding, expected.is_colliding);
  ASSERT_EQ(answer.contacts.size(), expected.contacts.size());
  for (std::size_t i = 0; i < answer.contacts.size(); ++i) {
    EXPECT_EQ(answer.contacts[i].submap, expected.contacts[i].submap);
    EXPECT_EQ(answer.contacts[i].depth_m, expected.contacts[i].depth_m);
    EXPECT_EQ(answer.contacts[i].point_m, expected.contacts[i].point_m);
  }
}

TEST(BodyCheck, AnswersTheSameInPiecesAsAtOnce) {
  SurfaceCache cache(kRoomForSheet);
  const std::vector<Body> bodies = SomeBodies();
  std::vector<BodyAnswer> expected, answers;
  ASSERT_TRUE(CheckBodies(MapView(SmallSheet()), cache, Heedless(), bodies, {}, [&](const BodyAnswer& answer) {
                expected.push_back(answer);
              }).ok());
  ASSERT_EQ(expected.size(), bodies.size());
  BodyCheck check(SmallSheet(), cache, Heedless(), bodies);
  std::size_t num_pieces = 0;
  for (bool has_more = true; has_more; ++num_pieces) {
    const auto next = check.Next({.work = 1}, {}, [&](const BodyAnswer& answer) { answers.push_back(answer); });
    ASSERT_TRUE(next.ok()) << next.status().ToString();
    has_more = *next;
  }
  EXPECT_EQ(num_pieces, bodies.size()) << "each by itself takes as much as was asked for, and more";
  ASSERT_EQ(answers.size(), expected.size());
  for (std::size_t i = 0; i < answers.size(); ++i) ExpectSameAnswer(expected[i], answers[i]);
}

TEST(BodyCheck, LeavesLongWorkToALongerPiece) {
  SurfaceCache cache(kRoomForSheet);
  const std::vector<Body> bodies = SomeBodies();
  BodyCheck check(SmallSheet(), cache, Heedless(), bodies);
  std::size_t num_answered = 0;
  const auto count = [&](const BodyAnswer&) { ++num_answered; };
  for (int round = 0; round < 200; ++round) {
    ASSERT_TRUE(*check.Next({.work = 1500, .may_overrun = false}, {}, count));
  }
  EXPECT_EQ(num_answered, bodies.size() - 1) << "all but the large box";
  EXPECT_FALSE(*check.Next({}, {}, count));
  EXPECT_EQ(num_answered, bodies.size());
}

TEST(BodyCheck, IsLimitedByItsWorkAndNotByTheNumberOfBodies) {
  SurfaceCache cache(kRoomForSheet);
  const auto outcome = [&](const std::vector<Body>& bodies, double padding_m, UnknownSpace unknown) {
    CheckQuestion question = Heedless();
    question.options.unknown = unknown;
    question.options.scope.padding.default_m = padding_m;
    BodyCheck check(SmallSheet(), cache, question, bodies, /*most_work=*/20'000);
    for (;;) {
      const auto next = check.Next({}, {}, [](const BodyAnswer&) {});
      if (!next.ok() || !*next) return next.status();
    }
  };
  const Body small = OrientedBox{Transform(Eigen::Translation3d(1, 1, 0.9)), {0.01, 0.01, 0.01}};
  const Body large = OrientedBox{Transform(Eigen::Translation3d(1, 1, 0.9)), {5, 5, 5}};
  EXPECT_TRUE(outcome(std::vector<Body>(200, small), 0, UnknownSpace::kFree).ok());
  for (const Status& status : {outcome(std::vector<Body>(20, large), 0, UnknownSpace::kFree),
                               outcome(std::vector<Body>(200, small), 10, UnknownSpace::kFree)}) {
    EXPECT_EQ(status.code(), StatusCode::kResourceExhausted) << status.ToString();
    ASSERT_EQ(status.violations().size(), 1u);
    EXPECT_EQ(status.violations()[0].field, "bodies");
  }
}

TEST(BodyCheck, EndsSoonWithinABody) {
  SurfaceCache cache(kRoomForSheet);
  const std::vector<Body> one = {OrientedBox{Transform(Eigen::Translation3d(2, 2, 0)), {5, 5, 5}}};
  std::stop_source gone;
  gone.request_stop();
  WorkBudget work(1'000'000'000, gone.get_token());
  const BodyQuery query(cache.Of(SmallSheet(), {}), Heedless().options);
  (void)query.Check(one[0], 3, &work);
  EXPECT_TRUE(work.is_over());
  EXPECT_LT(work.spent(), 1'000);
  WorkBudget whole;
  (void)query.Check(one[0], 3, &whole);
  EXPECT_FALSE(whole.is_over());
  EXPECT_GT(whole.spent(), 2'000) << "else this shows nothing";
}

TEST(TrajectoryCheck, IsLimitedByItsWorkAndAnswersTheSameInPieces) {
  SurfaceCache cache(kRoomForSheet);
  const auto motion_of = [](std::size_t number) {
    RobotMotion motion;
    motion.spheres.emplace_back();
    for (int i = 0; i < 30; ++i) {
      motion.spheres.back().push_back(
          {static_cast<double>(i), {0.1 * i, 1, number % 2 == 0 ? 0.9 : 0.9 - 0.04 * i}, 0.1});
    }
    return motion;
  };
  constexpr std::size_t kMotions = 130;  // more than surfaces are kept for
  std::vector<bool> expected, valid;
  CheckQuestion question = Heedless();
  question.max_contacts = 1;
  ASSERT_TRUE(
      CheckTrajectories(MapView(SmallSheet()), cache, question, kMotions, motion_of, {}, [&](const auto& answer) {
        expected.push_back(answer.is_valid);
      }).ok());
  TrajectoryCheck check(SmallSheet(), cache, question, kMotions, motion_of);
  while (*check.Next({.work = 1}, {}, [&](const TrajectoryAnswer& answer) { valid.push_back(answer.is_valid); })) {
  }
  EXPECT_EQ(valid, expected);
  EXPECT_TRUE(valid[0]);
  EXPECT_FALSE(valid[1]);
  TrajectoryCheck bound(SmallSheet(), cache, question, kMotions, motion_of, /*most_work=*/10'000);
  Result<bool> next = true;
  int num_answered = 0;
  while (next.ok() && *next) next = bound.Next({}, {}, [&](const TrajectoryAnswer&) { ++num_answered; });
  EXPECT_EQ(next.status().code(), StatusCode::kResourceExhausted);
  EXPECT_GT(num_answered, 0);
}

}  // namespace
}  // namespace dhpmap
