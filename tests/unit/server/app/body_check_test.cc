// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/body_check.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "server/app/trajectory_check.h"
#include "tests/unit/server/app/plane_map.h"

namespace dhpmap {
namespace {

using testing::PlaneMap;

/// In a frame that is shifted and turned, and heedless of what nobody has seen.
CheckQuestion Turned() {
  CheckQuestion question;
  question.options.unknown = UnknownSpace::kFree;
  question.T_map_query.translate(Eigen::Vector3d(1, 2, 3));
  question.T_map_query.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 1).normalized()));
  return question;
}

TEST(CheckBodies, SpeaksInTheAskersFrame) {
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

TEST(CheckTrajectories, SpeakInTheAskersFrame) {
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

TEST(CheckBodies, EndsSoonAfterTheCallerIsGone) {
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

}  // namespace
}  // namespace dhpmap
