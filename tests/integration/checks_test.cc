// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

/// A mapped TestScene, and checks of bodies and motions through both channels.
class ChecksTest : public ::testing::Test {
 protected:
  ChecksTest() {
    EXPECT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    EXPECT_OK(Feed(server, "room", 0, 40));
    EXPECT_OK(server.Call(&MappingStub::FinishMapping, "maps/room"));
    collisions.set_map("maps/room");
    trajectory.set_map("maps/room");
  }
  void AddSphere(double x, double y, double z, double radius) {
    for (const double value : {x, y, z, radius}) collisions.add_packed_spheres_m(static_cast<float>(value));
  }
  v1::CheckCollisionsResponse Check() { return Check(server.channel()); }
  v1::CheckCollisionsResponse Check(const std::shared_ptr<grpc::Channel>& channel) {
    return Client(channel).Call(&QueryStub::CheckCollisions, collisions).KeepStatus(status);
  }
  v1::CheckTrajectoryResponse Go() { return Go(server.channel()); }
  v1::CheckTrajectoryResponse Go(const std::shared_ptr<grpc::Channel>& channel) {
    return Client(channel).Call(&QueryStub::CheckTrajectory, trajectory).KeepStatus(status);
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store};
  v1::CheckCollisionsRequest collisions;
  v1::CheckTrajectoryRequest trajectory;
  grpc::Status status;
};

TEST_F(ChecksTest, BodiesTouchTheSceneThroughBothDoors) {
  collisions.mutable_options()->set_unknown_policy(v1::QueryOptions::FREE);
  const double above_m = TestScene().Distance({0, 0, 1.3});
  AddSphere(0, 0, 1.3, above_m + 0.05);
  AddSphere(0, 0, 1.3, above_m - 0.05);
  v1::OrientedBox& box = *collisions.add_bodies()->mutable_box();
  box.mutable_pose()->mutable_translation_m()->set_z(1.3);
  for (const auto set : {&v1::Vector3::set_x, &v1::Vector3::set_y}) (box.mutable_size_m()->*set)(0.1);
  box.mutable_size_m()->set_z(2 * above_m + 0.1);
  v1::Capsule& capsule = *collisions.add_bodies()->mutable_capsule();
  capsule.mutable_a_m()->set_z(1.3);
  capsule.mutable_b_m()->set_z(1.5);
  capsule.set_radius_m(above_m - 0.05);
  const v1::CheckCollisionsResponse response = Check();
  ASSERT_OK(status);
  ASSERT_EQ(response.results_size(), 4);
  const bool expected[] = {true, false, true, false};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(response.results(i).colliding(), expected[i]) << i;
    EXPECT_EQ(response.results(i).contacts_size(), expected[i] ? 1 : 0);
    EXPECT_EQ(response.results(i).status(), v1::QueryStatus::OK);
  }
  const v1::Contact& contact = response.results(0).contacts(0);
  EXPECT_NEAR(contact.depth_m(), 0.05, 0.03);
  EXPECT_GT(contact.normal().z(), 0.95);
  EXPECT_GT(contact.instance_id(), 0);
  EXPECT_EQ(contact.submap(), "maps/room/submaps/" + std::to_string(contact.instance_id()));
  EXPECT_FALSE(contact.class_name().empty());
  EXPECT_NEAR(response.results(2).contacts(0).depth_m(), 0.05, 0.04);
  EXPECT_EQ(Check(server.grpc().InProcessChannel()).SerializeAsString(), response.SerializeAsString())
      << "the door that REST goes through";
  collisions.set_packed(true);
  const v1::PackedCollisionResults packed = Check().packed();
  ASSERT_EQ(packed.colliding_size(), 4);
  ASSERT_EQ(packed.point_m_size(), 12);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(packed.colliding(i), expected[i]);
  EXPECT_EQ(packed.depth_m(0), contact.depth_m());
  EXPECT_EQ(packed.instance_id(0), contact.instance_id());
  EXPECT_EQ(packed.instance_id(1), -1);
  EXPECT_TRUE(std::isnan(packed.point_m(3)));
  collisions.set_skip_contacts(true);
  EXPECT_EQ(Check().packed().colliding(0), true);
  EXPECT_EQ(Check().packed().depth_m_size(), 0);
}

TEST_F(ChecksTest, UnseenSpaceBlocksByDefault) {
  AddSphere(30, 0, 1, 0.1);
  const v1::CollisionResult result = Check().results(0);
  EXPECT_TRUE(result.colliding());
  EXPECT_EQ(result.status(), v1::QueryStatus::UNKNOWN);
  ASSERT_EQ(result.contacts_size(), 1);
  EXPECT_EQ(result.contacts(0).instance_id(), -1);
  collisions.mutable_options()->set_unknown_policy(v1::QueryOptions::REPORT);
  EXPECT_FALSE(Check().results(0).colliding());
  EXPECT_EQ(Check().results(0).status(), v1::QueryStatus::UNKNOWN);
  for (int i = 0; i < 300; ++i) AddSphere(30, 0, 1, 0.1);
  EXPECT_EQ(Check().results_size(), 301) << "in the bulk lane";
}

TEST_F(ChecksTest, ARobotThatFallsOntoTheBallIsStoppedThroughBothDoors) {
  trajectory.mutable_options()->set_unknown_policy(v1::QueryOptions::FREE);
  v1::Sphere& sphere = *trajectory.add_robot();
  sphere.set_radius_m(0.1);
  for (const double z : {2.3, 2.2, 0.2}) {
    if (z == 2.3) trajectory.add_trajectories();
    trajectory.mutable_trajectories(0)->add_waypoints()->mutable_translation_m()->set_z(z);
  }
  trajectory.add_trajectories()->add_waypoints()->mutable_translation_m()->set_z(2.3);
  const v1::CheckTrajectoryResponse response = Go();
  ASSERT_OK(status);
  ASSERT_EQ(response.results_size(), 2);
  EXPECT_FALSE(response.results(0).valid());
  EXPECT_TRUE(response.results(1).valid());
  ASSERT_EQ(response.results(0).contacts_size(), 1);
  const v1::TrajectoryContact& contact = response.results(0).contacts(0);
  EXPECT_EQ(contact.waypoint(), 1);
  EXPECT_EQ(contact.sphere(), 0);
  const double fall_m = TestScene().Distance({0, 0, 2.2}) - 0.1;
  EXPECT_NEAR(contact.fraction(), fall_m / 2, 0.02);
  EXPECT_GT(contact.contact().normal().z(), 0.95);
  EXPECT_GT(contact.contact().instance_id(), 0);
  EXPECT_EQ(Go(server.grpc().InProcessChannel()).SerializeAsString(), response.SerializeAsString());

  v1::CheckTrajectoryRequest packed;
  packed.set_map("maps/room");
  *packed.mutable_options() = trajectory.options();
  packed.set_num_waypoints(3);
  packed.set_num_spheres(2);
  packed.set_packed(true);
  for (const double x : {0.0, 0.02}) {
    for (const double z : {2.3, 2.2, 0.2}) {
      for (const double radius : {0.02, 0.1}) {
        for (const double value : {x, 0.0, z, radius}) packed.add_packed_spheres_m(static_cast<float>(value));
      }
    }
  }
  trajectory = packed;
  const v1::PackedTrajectoryResults results = Go().packed();
  ASSERT_OK(status) << ViolationOf(status);
  ASSERT_EQ(results.valid_size(), 2);
  EXPECT_EQ(results.waypoint(0), 1);
  EXPECT_EQ(results.sphere(0), 1);
  EXPECT_NEAR(results.fraction(0), contact.fraction(), 1e-4);
  EXPECT_EQ(results.instance_id(0), contact.contact().instance_id());
}

TEST_F(ChecksTest, AnAttachedObjectDoesNotBlockItsRobot) {
  trajectory.mutable_options()->set_unknown_policy(v1::QueryOptions::FREE);
  trajectory.add_robot()->set_radius_m(0.1);
  trajectory.add_trajectories();
  for (const double z : {1.3, 0.7}) {
    trajectory.mutable_trajectories(0)->add_waypoints()->mutable_translation_m()->set_z(z);
  }
  const v1::CheckTrajectoryResponse before = Go();
  ASSERT_EQ(before.results(0).contacts_size(), 1);
  const std::string ball = before.results(0).contacts(0).contact().submap();
  v1::AttachedSubmap& attached = *trajectory.mutable_options()->add_attached();
  attached.set_submap(ball);
  attached.mutable_robot_from_submap()->mutable_translation_m()->set_z(20);  // held up high
  EXPECT_TRUE(Go().results(0).valid()) << Go().DebugString();
  attached.mutable_robot_from_submap()->mutable_translation_m()->set_z(-1.5);  // through the floor
  const v1::CheckTrajectoryResponse low = Go();
  ASSERT_EQ(low.results(0).contacts_size(), 1);
  EXPECT_EQ(low.results(0).contacts(0).attached(), ball);
  EXPECT_EQ(low.results(0).contacts(0).sphere(), -1);
  v1::AllowedCollision& pair = *trajectory.mutable_options()->add_allowed_collisions();
  pair.set_attached(ball);
  pair.set_submap(low.results(0).contacts(0).contact().submap());
  const v1::CheckTrajectoryResponse ignored = Go();
  for (const auto& contact : ignored.results(0).contacts()) EXPECT_NE(contact.contact().submap(), pair.submap());
}

TEST_F(ChecksTest, BadBodiesAreNamed) {
  struct Case {
    std::function<void(v1::CheckCollisionsRequest&)> spoil;
    std::string field;
  };
  const auto sphere = [](float x, float radius) {
    return [=](auto& r) {
      for (const float value : {0.f, 0.f, 0.f, 1.f, x, 0.f, 0.f, radius}) r.add_packed_spheres_m(value);
    };
  };
  const auto body = [](const std::function<void(v1::Body&)>& make) {
    return [=](auto& r) { r.add_bodies()->mutable_sphere(), make(*r.add_bodies()); };
  };
  const Case cases[] = {
      {sphere(NAN, 1), "packed_spheres_m sphere 1 is"},
      {sphere(0, -0.1f), "packed_spheres_m sphere 1 is"},
      {sphere(0, NAN), "packed_spheres_m sphere 1 is"},
      {sphere(0, 11), "packed_spheres_m sphere 1 is"},
      {sphere(1e30f, 1), "packed_spheres_m sphere 1 is"},
      {[](auto& r) { r.add_packed_spheres_m(1); }, "packed_spheres_m has 1 values"},
      {[](auto& r) { r.mutable_packed_spheres_m()->Resize(4 * 1'000'001, 0); }, "packed_spheres_m 1000001 bodies"},
      {body([](auto&) {}), "bodies[1] has no shape"},
      {body([](auto& b) { b.mutable_sphere()->set_radius_m(-1); }), "bodies[1].sphere is"},
      {body([](auto& b) { b.mutable_capsule()->mutable_b_m()->set_x(INFINITY); }), "bodies[1].capsule is"},
      {body([](auto& b) { b.mutable_capsule()->mutable_b_m()->set_x(50); }), "bodies[1].capsule is longer"},
      {body([](auto& b) { b.mutable_box()->mutable_size_m()->set_y(-1); }), "bodies[1].box.size_m is"},
      {body([](auto& b) { b.mutable_box()->mutable_pose()->mutable_rotation(); }), "bodies[1].box.pose"},
      {[](auto& r) { r.set_max_contacts(2); }, "max_contacts"},
      {[](auto& r) { r.set_all_contacts(true), r.set_max_contacts(1001); }, "max_contacts"},
      {[](auto& r) { r.set_all_contacts(true), r.set_packed(true); }, "all_contacts"},
      {[](auto& r) { r.mutable_options()->add_allowed_collisions(); }, "options.allowed_collisions"},
      {[](auto& r) {
         r.mutable_options()->add_attached()->set_submap("maps/room/submaps/1");
         r.mutable_options()->mutable_attached(0)->mutable_robot_from_submap();
       },
       "options.attached[0].robot_from_submap"},
  };
  for (const Case& c : cases) {
    collisions.Clear();
    collisions.set_map("maps/room");
    c.spoil(collisions);
    Check();
    EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT) << c.field;
    EXPECT_EQ(ViolationOf(status).substr(0, c.field.size()), c.field) << ViolationOf(status);
  }
}

TEST_F(ChecksTest, BadTrajectoriesAreNamed) {
  struct Case {
    std::function<void(v1::CheckTrajectoryRequest&)> spoil;
    std::string field;
  };
  const auto rigid = [](const std::function<void(v1::CheckTrajectoryRequest&)>& spoil) {
    return [=](v1::CheckTrajectoryRequest& r) {
      r.add_robot()->set_radius_m(0.1);
      r.add_trajectories()->add_waypoints();
      spoil(r);
    };
  };
  const auto packed = [](const std::function<void(v1::CheckTrajectoryRequest&)>& spoil) {
    return [=](v1::CheckTrajectoryRequest& r) {
      r.set_num_waypoints(2);
      r.set_num_spheres(1);
      r.mutable_packed_spheres_m()->Resize(8, 0.5f);
      spoil(r);
    };
  };
  const auto attach = [](v1::CheckTrajectoryRequest& r) {
    r.mutable_options()->add_attached()->set_submap("maps/room/submaps/1");
  };
  const Case cases[] = {
      {rigid([](auto& r) { r.clear_robot(); }), "robot has no spheres"},
      {rigid([](auto& r) { r.add_robot()->set_radius_m(-1); }), "robot[1] is"},
      {rigid([](auto& r) { r.add_robot()->mutable_center_m()->set_x(101); }), "robot[1] is"},
      {rigid([](auto& r) { r.add_trajectories(); }), "trajectories[1].waypoints are"},
      {rigid([](auto& r) { r.mutable_trajectories(0)->add_waypoints()->mutable_rotation(); }),
       "trajectories[0].waypoints[1]"},
      {rigid([](auto& r) { r.mutable_trajectories(0)->add_waypoints()->mutable_translation_m()->set_x(NAN); }),
       "trajectories[0].waypoints[1]"},
      {rigid([](auto& r) { r.set_num_spheres(3); }), "num_spheres has no meaning"},
      {rigid([](auto& r) {
         for (int i = 0; i < 999; ++i) r.add_robot();
         for (int i = 0; i < 1001; ++i) r.mutable_trajectories(0)->add_waypoints();
       }),
       "trajectories 1002000 spheres"},
      {packed([](auto& r) { r.set_packed_spheres_m(6, NAN); }), "packed_spheres_m sphere 1 is"},
      {packed([](auto& r) { r.set_packed_spheres_m(3, -1); }), "packed_spheres_m sphere 0 is"},
      {packed([](auto& r) { r.add_packed_spheres_m(1); }), "packed_spheres_m has 9 values"},
      {packed([](auto& r) { r.set_num_waypoints(0); }), "num_waypoints"},
      {packed([](auto& r) { r.set_num_spheres(-1); }), "num_spheres"},
      {packed([](auto& r) { r.set_num_waypoints(10'000), r.set_num_spheres(2'000'000'000); }),
       "packed_spheres_m has 8"},
      {packed([](auto& r) { r.add_robot(); }), "robot does not"},
      {packed(attach), "packed_attached_poses has 0 values"},
      {packed([&](auto& r) { attach(r), r.mutable_packed_attached_poses()->Resize(14, 0); }),
       "packed_attached_poses pose 0"},
      {packed([](auto& r) { r.mutable_options()->add_allowed_collisions()->set_attached("maps/room/submaps/1"); }),
       "options.allowed_collisions[0].attached is not attached"},
      {packed([&](auto& r) {
         attach(r), r.mutable_options()->mutable_attached(0)->mutable_robot_from_submap()->mutable_rotation();
       }),
       "options.attached[0].robot_from_submap"},
  };
  for (const Case& c : cases) {
    trajectory.Clear();
    trajectory.set_map("maps/room");
    c.spoil(trajectory);
    Go();
    EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT) << c.field;
    EXPECT_EQ(ViolationOf(status).substr(0, c.field.size()), c.field) << ViolationOf(status);
  }
  trajectory.mutable_options()->Clear();
  attach(trajectory);
  trajectory.mutable_options()->mutable_attached(0)->set_submap("maps/room/submaps/4000000");
  Go();
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
}

}  // namespace
}  // namespace dhpmap::testing
