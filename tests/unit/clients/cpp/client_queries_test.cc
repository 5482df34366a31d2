// SPDX-License-Identifier: BSD-3-Clause
// What the C++ client asks of a real server.
#include <cmath>
#include <random>

#include "tests/unit/clients/cpp/client_room.h"

namespace dhpmap::testing {
namespace {

using client::Vector3;

/// Around TestScene, where something is known.
std::vector<Vector3> PointsAround(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-0.5, 1.5);
  std::vector<Vector3> points_m;
  for (int i = 0; i < count; ++i) points_m.push_back(Vector3{u(random), u(random), u(random)});
  return points_m;
}

const client::Spheres kBall{.spheres_m = {{{0, 0, 0}, 0.1}}, .may_touch = {}};

using ClientQueries = ClientRoom;

TEST_F(ClientQueries, DistancesAreThoseOfTheScene) {
  const std::vector<Vector3> points_m = PointsAround(200);
  ASSERT_OK_AND_ASSIGN(const auto answers, room.Distances(points_m, {.unknown = client::Unknown::kFree}));
  ASSERT_EQ(answers.size(), points_m.size());
  int num_compared = 0;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const double truth_m = TestScene().Distance({points_m[i].x, points_m[i].y, points_m[i].z});
    if (truth_m < 0.1) continue;  // insides are not seen
    EXPECT_NEAR(answers[i].distance_m, truth_m, 0.08) << i;
    const Vector3& g = answers[i].gradient;
    EXPECT_NEAR(std::hypot(g.x, g.y, g.z), 1, 1e-3);
    ++num_compared;
  }
  EXPECT_GT(num_compared, 50);
}

TEST_F(ClientQueries, AnIgnoredObjectIsNotThere) {
  const client::Object ball = ObjectOf(1);
  const std::vector<Vector3> above_ball{{0, 0, 1.0}};
  ASSERT_OK_AND_ASSIGN(const auto with, room.Distances(above_ball));
  ASSERT_OK_AND_ASSIGN(const auto by_id, room.Distances(above_ball, {.ignore = {ball.id}}));
  ASSERT_OK_AND_ASSIGN(const auto by_class, room.Distances(above_ball, {.ignore = {ball.class_name}}));
  EXPECT_EQ(with[0].object_id, ball.id);
  EXPECT_NE(by_id[0].object_id, ball.id);
  EXPECT_GT(by_id[0].distance_m, with[0].distance_m);
  EXPECT_EQ(by_class[0].distance_m, by_id[0].distance_m);
}

TEST_F(ClientQueries, PointsRaysAndBallsMeetTheBox) {
  const client::Object box = ObjectOf(2);
  ASSERT_OK_AND_ASSIGN(const auto points, room.Points(std::vector<Vector3>{{1.2, 0.3, 0.6}, {1.2, 0.3, 1.2}}));
  EXPECT_TRUE(points[0].is_near_surface);
  EXPECT_EQ(points[0].object_id, box.id);
  EXPECT_EQ(points[0].class_id, 2);
  EXPECT_FALSE(points[1].is_near_surface);
  EXPECT_TRUE(points[1].is_free);

  const std::vector<client::Ray> down{{{1.2, 0.3, 1.2}, {0, 0, -2}}};
  ASSERT_OK_AND_ASSIGN(const auto rays, room.CastRays(down));
  EXPECT_TRUE(rays[0].is_hit);
  EXPECT_NEAR(rays[0].distance_m, 0.6, 0.05);
  EXPECT_NEAR(rays[0].normal.z, 1, 0.05);
  EXPECT_EQ(rays[0].object_id, box.id);

  const std::vector<client::Sphere> balls{{{1.2, 0.3, 0.7}, 0.2}, {{1.2, 0.3, 1.0}, 0.2}};
  ASSERT_OK_AND_ASSIGN(const auto touched, room.Collisions(balls));
  EXPECT_TRUE(touched[0].is_colliding);
  EXPECT_EQ(touched[0].object_id, box.id);
  EXPECT_NEAR(touched[0].depth_m, 0.1, 0.05);
  EXPECT_FALSE(touched[1].is_colliding);

  const std::vector<client::Body> bodies{balls[0], client::OrientedBox{{{1.2, 0.3, 1.0}}, {0.2, 0.2, 0.2}},
                                         client::Capsule{{1.2, 0.3, 0.9}, {1.2, 0.3, 0.5}, 0.05}};
  ASSERT_OK_AND_ASSIGN(const auto checked, room.CheckBodies(bodies));
  EXPECT_TRUE(checked[0].is_colliding);
  EXPECT_FALSE(checked[1].is_colliding);
  EXPECT_TRUE(checked[2].is_colliding);
  ASSERT_FALSE(checked[0].contacts.empty());
  EXPECT_EQ(checked[0].contacts[0].object.id, box.id);
}

TEST_F(ClientQueries, APathThatMeetsTheBallSaysWhereAndAFreeOneHowNear) {
  const client::Object ball = ObjectOf(1);
  const std::vector<client::Pose> through{client::PoseAt({-0.9, 0, 0.9}), client::PoseAt({0.6, 0, 0.4})};
  const std::vector<client::Pose> over{client::PoseAt({-0.3, 0, 1.1}), client::PoseAt({0.6, 0, 1.1})};
  const client::QueryOptions free{.unknown = client::Unknown::kFree};
  ASSERT_OK_AND_ASSIGN(const auto met, room.CheckPath(kBall, through, free));
  EXPECT_FALSE(met.ok);
  ASSERT_EQ(met.contacts.size(), 1);
  EXPECT_EQ(met.contacts[0].contact.object.id, ball.id);
  EXPECT_EQ(met.contacts[0].place.waypoint, 0);
  EXPECT_EQ(met.contacts[0].place.sphere, 0);

  const std::vector<std::vector<client::Pose>> both{through, over};
  ASSERT_OK_AND_ASSIGN(const auto checks, room.CheckPaths(kBall, both, free, {.include_clearance = true}));
  ASSERT_EQ(checks.size(), 2);
  EXPECT_FALSE(checks[0].ok);
  EXPECT_TRUE(checks[1].ok);
  ASSERT_TRUE(checks[1].clearance.has_value());
  EXPECT_NEAR(checks[1].clearance->distance_m, 1.1 - 0.8 - 0.1, 0.05);
  EXPECT_EQ(checks[1].clearance->object.id, ball.id);

  const client::Spheres may_touch{.spheres_m = kBall.spheres_m, .may_touch = {ball.id}};
  ASSERT_OK_AND_ASSIGN(const auto allowed, room.CheckPath(may_touch, through, free));
  EXPECT_TRUE(allowed.ok);
}

TEST_F(ClientQueries, PosesAreCheckedEachByItself) {
  const std::vector<client::Pose> poses{client::PoseAt({0, 0, 0.8}), client::PoseAt({0, 0, 1.2}),
                                        client::PoseAt({1.2, 0.3, 0.6})};
  ASSERT_OK_AND_ASSIGN(const auto checks, room.CheckPoses(kBall, poses, {.unknown = client::Unknown::kFree}));
  ASSERT_EQ(checks.size(), 3);
  EXPECT_FALSE(checks[0].ok);
  EXPECT_TRUE(checks[1].ok);
  EXPECT_FALSE(checks[2].ok);
}

TEST_F(ClientQueries, ObjectsAreFoundListedAndGot) {
  const client::Object ball = ObjectOf(1), box = ObjectOf(2);
  EXPECT_EQ(ball.kind, client::Kind::kThing);
  ASSERT_TRUE(ball.box.has_value());
  EXPECT_NEAR(ball.box->size_m.z, 0.75, 0.15);
  ASSERT_TRUE(ball.last_seen_ns.has_value());

  ASSERT_OK_AND_ASSIGN(const auto near_box, room.Find("", {.near_m = Vector3{1.2, 0.3, 1}, .limit = 1}));
  ASSERT_EQ(near_box.size(), 1);
  EXPECT_EQ(near_box[0].id, box.id);
  EXPECT_NEAR(near_box[0].distance_m, 0.4, 0.05);
  ASSERT_OK_AND_ASSIGN(const auto balls, room.Find(ball.class_name));
  ASSERT_EQ(balls.size(), 1);
  EXPECT_TRUE(std::isnan(balls[0].distance_m));
  ASSERT_OK_AND_ASSIGN(const auto got, room.Get(ball.id));
  EXPECT_EQ(got.etag, ball.etag);

  const auto missing = room.Get(999);
  EXPECT_EQ(missing.status().code, client::StatusCode::kNotFound);
  EXPECT_EQ(missing.status().reason, "SUBMAP_NOT_FOUND");
  const auto unknown_class = room.Find("soffa");
  EXPECT_EQ(unknown_class.status().code, client::StatusCode::kInvalidArgument);
  EXPECT_FALSE(unknown_class.status().violations.empty());
}

TEST_F(ClientQueries, WhatIsPinnedStaysAsItWasWhileTheMapGoesOn) {
  const client::Object ball = ObjectOf(1);
  const std::vector<Vector3> above_ball{{0, 0, 1.0}};
  ASSERT_OK_AND_ASSIGN(const auto pinned, room.Pin());
  ASSERT_OK_AND_ASSIGN(const auto before, pinned.Distances(above_ball));
  EXPECT_EQ(before.revision, pinned.revision());
  client::Edit edit = room.Edit();
  edit.MoveBy(ball.id, {0, 0, 2});
  ASSERT_OK_AND_ASSIGN(const auto edited, edit.Apply());
  ASSERT_OK_AND_ASSIGN(const auto after, pinned.Distances(above_ball));
  EXPECT_EQ(after.revision, pinned.revision());
  EXPECT_EQ(after[0].distance_m, before[0].distance_m);
  ASSERT_OK_AND_ASSIGN(const auto now, room.Distances(above_ball));
  EXPECT_EQ(now.revision, edited.revision);
  EXPECT_NE(now[0].distance_m, before[0].distance_m);
  ASSERT_OK_AND_ASSIGN(const auto past, room.At(pinned.revision()).Distances(above_ball));
  EXPECT_EQ(past[0].distance_m, before[0].distance_m);
}

TEST_F(ClientQueries, ALoopAnswersAsCallsDoAndGoesOnAfterAnError) {
  client::Loop loop = room.Loop();
  const std::vector<Vector3> points_m = PointsAround(20);
  ASSERT_OK_AND_ASSIGN(const auto called, room.Distances(points_m));
  ASSERT_OK_AND_ASSIGN(const auto revision, loop.Pin());
  EXPECT_EQ(revision, called.revision);
  const auto bad = loop.Distances(std::vector<Vector3>{{std::nan(""), 0, 0}});
  EXPECT_EQ(bad.status().code, client::StatusCode::kInvalidArgument);
  ASSERT_OK_AND_ASSIGN(const auto answers, loop.Distances(points_m));
  for (std::size_t i = 0; i < points_m.size(); ++i) EXPECT_EQ(answers[i].distance_m, called[i].distance_m);
  ASSERT_OK(loop.Unpin());
  ASSERT_OK_AND_ASSIGN(const auto check, loop.CheckPath(kBall, std::vector<client::Pose>{client::PoseAt({0, 0, 1.2})},
                                                        {.unknown = client::Unknown::kFree}));
  EXPECT_TRUE(check.ok);
}

TEST_F(ClientQueries, AMapThatIsNotThereIsToldWithThoseThatAre) {
  const auto missing = connection.OpenMap("kitchen");
  EXPECT_EQ(missing.status().code, client::StatusCode::kNotFound);
  EXPECT_EQ(missing.status().reason, "MAP_NOT_FOUND");
  EXPECT_NE(missing.status().message.find("room"), std::string::npos) << missing.status().ToString();
  ASSERT_OK_AND_ASSIGN(const auto maps, connection.Maps());
  ASSERT_EQ(maps.size(), 1);
  EXPECT_EQ(maps[0].name, "room");
  ASSERT_OK_AND_ASSIGN(const auto info, room.Info());
  EXPECT_EQ(info.num_frames, 12);
  EXPECT_EQ(info.classes.size(), 3);
}

}  // namespace
}  // namespace dhpmap::testing
