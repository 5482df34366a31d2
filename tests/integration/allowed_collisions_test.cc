// SPDX-License-Identifier: BSD-3-Clause
// A wheeled robot on the floor of the scene: allowed contacts and clearance, through both doors.
#include <cmath>
#include <string>

#include "tests/integration/mapped_scene.h"

namespace dhpmap::testing {
namespace {

constexpr double kWheel_m = 0.08, kBody_m = 0.15;

class WheeledRobot : public MappedScene {
 protected:
  void SetUp() override { floor_ = ObjectOfClass(3); }

  /// A body on two wheels that dip a centimetre into the floor. It drives from beside the ball to x, between ball and
  /// box.
  static v1::CheckTrajectoryRequest Drive(double to_x) {
    v1::CheckTrajectoryRequest request;
    request.set_map("maps/room");
    const auto add = [&request](const char* link, double y, double z, double radius_m) {
      v1::Sphere& sphere = *request.add_robot();
      sphere.mutable_center_m()->set_y(y);
      sphere.mutable_center_m()->set_z(z);
      sphere.set_radius_m(radius_m);
      request.add_sphere_links(link);
    };
    add("left_wheel", 0.1, kWheel_m - 0.01, kWheel_m);
    add("right_wheel", -0.1, kWheel_m - 0.01, kWheel_m);
    add("body", 0, 0.25, kBody_m);
    v1::Trajectory& trajectory = *request.add_trajectories();
    for (const double x : {0.2, to_x}) {
      v1::Vector3& at_m = *trajectory.add_waypoints()->mutable_translation_m();
      at_m.set_x(x);
      at_m.set_y(-0.9);
    }
    return request;
  }
  static void Allow(const char* link, const std::string& class_name, v1::QueryOptions& options) {
    v1::AllowedCollision& allowed = *options.add_allowed_collisions();
    allowed.set_link(link);
    allowed.set_class_name(class_name);
  }
  v1::TrajectoryResult Ask(const v1::CheckTrajectoryRequest& request) {
    const auto response = server_->Call(&QueryStub::CheckTrajectory, request).KeepStatus(status_);
    const v1::CheckTrajectoryResponse in_process =
        Client(server_->grpc().InProcessChannel()).Call(&QueryStub::CheckTrajectory, request).value();
    EXPECT_EQ(in_process.SerializeAsString(), response.SerializeAsString()) << "the door of REST";
    return response.results_size() == 1 ? response.results(0) : v1::TrajectoryResult();
  }
  std::string ClassName(int class_id) { return MakeLabelSet(2, 1)->Find(ClassId(class_id))->name; }

  std::string floor_;
  grpc::Status status_;
};

TEST_F(WheeledRobot, OnlyItsWheelsMayTouchTheFloor) {
  v1::CheckTrajectoryRequest drive = Drive(0.8);
  EXPECT_FALSE(Ask(drive).valid()) << "today's answer";
  EXPECT_EQ(Ask(drive).contacts(0).contact().submap(), floor_);
  drive.mutable_options()->add_excluded_submaps(floor_);
  EXPECT_EQ(Ask(drive).status(), v1::QueryStatus::UNKNOWN) << "without the floor nobody knows what is there";
  drive.mutable_options()->clear_excluded_submaps();
  for (const char* wheel : {"left_wheel", "right_wheel"}) Allow(wheel, ClassName(3), *drive.mutable_options());
  const v1::TrajectoryResult valid = Ask(drive);
  ASSERT_OK(status_) << ViolationOf(status_);
  EXPECT_TRUE(valid.valid()) << valid.DebugString();
  EXPECT_EQ(valid.status(), v1::QueryStatus::OK);
  drive.mutable_robot(2)->mutable_center_m()->set_z(kBody_m - 0.03);
  const v1::TrajectoryResult low = Ask(drive);
  ASSERT_EQ(low.contacts_size(), 1) << "the body may not";
  EXPECT_EQ(low.contacts(0).sphere(), 2);
  EXPECT_EQ(low.contacts(0).contact().submap(), floor_);
  drive.mutable_robot(2)->mutable_center_m()->set_z(0.25);
  for (v1::Pose& pose : *drive.mutable_trajectories(0)->mutable_waypoints()) pose.mutable_translation_m()->set_y(0.3);
  drive.mutable_trajectories(0)->mutable_waypoints(0)->mutable_translation_m()->set_x(0.62);
  drive.mutable_trajectories(0)->mutable_waypoints(1)->mutable_translation_m()->set_x(0.9);
  const v1::TrajectoryResult box = Ask(drive);
  ASSERT_EQ(box.contacts_size(), 1);
  EXPECT_EQ(box.contacts(0).contact().class_name(), ClassName(2)) << "the box stays in the way, of wheels too";
}

TEST_F(WheeledRobot, ClearanceNamesThePointAndTheObject) {
  v1::CheckTrajectoryRequest drive = Drive(0.8);
  EXPECT_FALSE(Ask(drive).has_clearance());
  drive.set_include_clearance(true);
  ASSERT_TRUE(Ask(drive).has_clearance());
  EXPECT_NEAR(Ask(drive).clearance().distance_m(), -0.01, 0.01) << "wheels in the floor";
  EXPECT_EQ(Ask(drive).clearance().submap(), floor_);
  for (const char* wheel : {"left_wheel", "right_wheel"}) Allow(wheel, ClassName(3), *drive.mutable_options());
  const v1::Clearance least = Ask(drive).clearance();
  EXPECT_NEAR(least.distance_m(), 0.25 - kBody_m, 0.01) << "of the body, above the floor";
  EXPECT_EQ(least.sphere(), 2);
  EXPECT_EQ(least.submap(), floor_);
  EXPECT_EQ(least.class_name(), ClassName(3));
  EXPECT_NEAR(least.point_m().z(), 0, 0.01);
  EXPECT_TRUE(least.waypoint() == 0 || least.fraction() == 0);
  Allow("body", ClassName(3), *drive.mutable_options());
  const v1::Clearance ball = Ask(drive).clearance();
  const double gap_m = std::sqrt(0.2 * 0.2 + 0.9 * 0.9 + 0.15 * 0.15) - 0.4 - kBody_m;  // of the body at the start
  EXPECT_NEAR(ball.distance_m(), gap_m, 0.02);
  EXPECT_EQ(ball.class_name(), ClassName(1));
  EXPECT_EQ(ball.sphere(), 2);
  EXPECT_EQ(ball.waypoint(), 0);
  EXPECT_EQ(ball.fraction(), 0);
  drive.set_packed(true);
  const auto packed = server_->Call(&QueryStub::CheckTrajectory, drive).value().packed();
  ASSERT_EQ(packed.clearance_m_size(), 1);
  EXPECT_EQ(packed.clearance_m(0), static_cast<float>(ball.distance_m()));
  drive.mutable_options()->set_max_distance_m(0.9 * gap_m);
  EXPECT_TRUE(std::isnan(server_->Call(&QueryStub::CheckTrajectory, drive).value().packed().clearance_m(0)));
  drive.set_packed(false);
  EXPECT_FALSE(Ask(drive).has_clearance()) << "there is nothing so near";
}

TEST_F(WheeledRobot, BodiesAlsoHaveLinks) {
  v1::CheckCollisionsRequest request;
  request.set_map("maps/room");
  for (const double z : {0.07, 0.07}) {
    for (const double value : {0.4, -0.9, z, kWheel_m}) request.add_packed_spheres_m(static_cast<float>(value));
  }
  for (const char* link : {"wheel", "body"}) request.add_body_links(link);
  Allow("wheel", ClassName(3), *request.mutable_options());
  const auto response = server_->Call(&QueryStub::CheckCollisions, request).value();
  ASSERT_EQ(response.results_size(), 2);
  EXPECT_FALSE(response.results(0).colliding());
  EXPECT_EQ(response.results(0).status(), v1::QueryStatus::OK);
  EXPECT_TRUE(response.results(1).colliding());
  request.mutable_options()->mutable_allowed_collisions(0)->set_link("whel");
  (void)server_->Call(&QueryStub::CheckCollisions, request).KeepStatus(status_);
  EXPECT_EQ(status_.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(ViolationOf(status_), "options.allowed_collisions[0].link 'whel' is no link that was named");
  EXPECT_NE(status_.error_message().find("options.allowed_collisions[0].link: 'whel' is no link"), std::string::npos)
      << "the message says it, too: " << status_.error_message();
  request.add_body_links("arm");
  (void)server_->Call(&QueryStub::CheckCollisions, request).KeepStatus(status_);
  EXPECT_EQ(ViolationOf(status_).substr(0, 22), "body_links has 3 names");
}

TEST_F(WheeledRobot, AGripperMayEnterAnIgnoredObjectIfItsSpaceCountsAsFree) {
  v1::CheckCollisionsRequest request;
  request.set_map("maps/room");
  for (const float value : {0.f, 0.f, 0.5f, 0.12f}) request.add_packed_spheres_m(value);
  const auto ask = [&] { return server_->Call(&QueryStub::CheckCollisions, request).value().results(0); };
  EXPECT_EQ(ask().contacts(0).submap(), ObjectOfClass(1));
  request.mutable_options()->add_excluded_submaps(ObjectOfClass(1));
  EXPECT_EQ(ask().status(), v1::QueryStatus::UNKNOWN) << "nobody has seen the inside of the ball";
  EXPECT_TRUE(ask().colliding());
  request.mutable_options()->set_vacated_policy(v1::Vacated::FREE);
  EXPECT_EQ(ask().status(), v1::QueryStatus::OK);
  EXPECT_FALSE(ask().colliding());
}

}  // namespace
}  // namespace dhpmap::testing
