// SPDX-License-Identifier: BSD-3-Clause
// Batches of motions of robots that carry objects, with all their contacts: compared with the same checks one by one.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/integration/mapped_scene.h"

namespace dhpmap::testing {
namespace {

/// The pose of a carrier at a waypoint, in numbers that a float represents exactly.
struct CarrierPose {
  float x, y, z;
  float quaternion_z = 0;  ///< with w = 1; need not be of unit length
};

// Three trajectories of three waypoints, with a sphere and carriers of the ball and the box. Beside both, above
// observed floor: the first lowers the ball into the floor, the second touches nothing, the third lowers first the
// sphere and then the box.
constexpr int kNumMotions = 3, kNumWaypoints = 3, kNumCarried = 2;
constexpr float kX_m = 0.5f, kY_m = -0.75f;
constexpr float kSphereZ_m[kNumMotions][kNumWaypoints] = {
    {1.25f, 1.25f, 1.25f}, {1.25f, 1.5f, 1.25f}, {1, -0.5f, -0.5f}};
constexpr float kSphereRadius_m = 0.125f;
constexpr CarrierPose kCarriers[kNumMotions][kNumWaypoints][kNumCarried] = {
    {{{kX_m, kY_m, 1}, {kX_m, kY_m, 1.25f}},
     {{kX_m, kY_m, 1, 1}, {kX_m, kY_m, 1.25f}},
     {{kX_m, kY_m, -1}, {kX_m, kY_m, 1.25f}}},
    {{{kX_m, kY_m, 1}, {kX_m, kY_m, 1.25f}},
     {{kX_m, kY_m, 1.25f}, {kX_m, kY_m, 1.25f}},
     {{kX_m, kY_m, 1}, {kX_m, kY_m, 1.5f}}},
    {{{kX_m, kY_m, 1}, {kX_m, kY_m, 1}}, {{kX_m, kY_m, 1}, {kX_m, kY_m, 1, -1}}, {{kX_m, kY_m, 1}, {kX_m, kY_m, -1}}}};

v1::Pose PoseOf(const CarrierPose& carrier) {
  v1::Pose pose;
  pose.mutable_translation_m()->set_x(carrier.x);
  pose.mutable_translation_m()->set_y(carrier.y);
  pose.mutable_translation_m()->set_z(carrier.z);
  pose.mutable_rotation()->set_z(carrier.quaternion_z);
  pose.mutable_rotation()->set_w(1);
  return pose;
}

class AttachedMotions : public MappedScene {
 protected:
  void SetUp() override {
    ball_ = ObjectOfClass(1);
    box_ = ObjectOfClass(2);
    ASSERT_FALSE(ball_.empty() || box_.empty());
  }

  /// Treats unobserved space as free, and attaches the ball and the box, each with its middle above its carrier.
  v1::CheckTrajectoryRequest Carrying() const {
    v1::CheckTrajectoryRequest request;
    request.set_map("maps/room");
    request.set_all_contacts(true);
    v1::QueryOptions& options = *request.mutable_options();
    options.set_unknown_policy(v1::QueryOptions::FREE);
    v1::AttachedSubmap& ball = *options.add_attached();
    ball.set_submap(ball_);
    ball.mutable_robot_from_submap()->mutable_translation_m()->set_z(0.25);
    ball.mutable_robot_from_submap()->mutable_rotation()->set_x(0.25);
    ball.mutable_robot_from_submap()->mutable_rotation()->set_w(1);
    v1::AttachedSubmap& box = *options.add_attached();
    box.set_submap(box_);
    box.mutable_robot_from_submap()->mutable_translation_m()->set_x(-1.25);
    box.mutable_robot_from_submap()->mutable_translation_m()->set_y(-0.25);
    return request;
  }
  /// Trajectories [begin, end) in one call.
  v1::CheckTrajectoryRequest Batch(int begin, int end) const {
    v1::CheckTrajectoryRequest request = Carrying();
    request.set_num_waypoints(kNumWaypoints);
    request.set_num_spheres(1);
    for (int b = begin; b < end; ++b) {
      for (int h = 0; h < kNumWaypoints; ++h) {
        for (const float value : {kX_m, kY_m, kSphereZ_m[b][h], kSphereRadius_m}) request.add_packed_spheres_m(value);
        for (const CarrierPose& c : kCarriers[b][h]) {
          for (const float value : {c.x, c.y, c.z, 0.f, 0.f, c.quaternion_z, 1.f}) {
            request.add_packed_attached_poses(value);
          }
        }
      }
    }
    return request;
  }
  /// Trajectory `b` of a robot that consists of one part only: attached object `part`, or the sphere. Other attached
  /// objects are held up where they touch nothing.
  v1::CheckTrajectoryRequest OnePart(int b, int part) const {
    v1::CheckTrajectoryRequest request = Carrying();
    for (int a = 0; a < kNumCarried; ++a) {
      if (a == part) continue;
      v1::Vector3& held_m =
          *request.mutable_options()->mutable_attached(a)->mutable_robot_from_submap()->mutable_translation_m();
      held_m.set_z(held_m.z() + 50);
    }
    if (part == kNumCarried) request.add_robot()->set_radius_m(kSphereRadius_m);
    v1::Trajectory& trajectory = *request.add_trajectories();
    for (int h = 0; h < kNumWaypoints; ++h) {
      *trajectory.add_waypoints() =
          part == kNumCarried ? PoseOf({kX_m, kY_m, kSphereZ_m[b][h]}) : PoseOf(kCarriers[b][h][part]);
    }
    return request;
  }
  v1::CheckTrajectoryResponse Ask(const v1::CheckTrajectoryRequest& request) {
    return server_->Call(&QueryStub::CheckTrajectory, request).KeepStatus(status_);
  }

  std::string ball_, box_;
  grpc::Status status_;
};

double TimeOf(const v1::TrajectoryContact& contact) {
  return contact.waypoint() + static_cast<double>(contact.fraction());
}

TEST_F(AttachedMotions, ABatchAnswersLikeItsTrajectoriesOneByOne) {
  const v1::CheckTrajectoryResponse batch = Ask(Batch(0, kNumMotions));
  ASSERT_OK(status_) << ViolationOf(status_);
  ASSERT_EQ(batch.results_size(), kNumMotions);
  for (int b = 0; b < kNumMotions; ++b) {
    const v1::CheckTrajectoryResponse alone = Ask(Batch(b, b + 1));
    ASSERT_OK(status_);
    ASSERT_EQ(alone.results_size(), 1);
    EXPECT_EQ(batch.results(b).SerializeAsString(), alone.results(0).SerializeAsString()) << b;
  }
  ASSERT_GT(batch.results(0).contacts_size(), 0);
  EXPECT_EQ(batch.results(0).contacts(0).attached(), ball_);
  EXPECT_EQ(batch.results(0).contacts(0).waypoint(), 1) << "on the way down";
  EXPECT_TRUE(batch.results(1).valid()) << batch.results(1).DebugString();
  ASSERT_GT(batch.results(2).contacts_size(), 1);
  EXPECT_EQ(batch.results(2).contacts(0).sphere(), 0);
  EXPECT_EQ(batch.results(2).contacts(0).waypoint(), 0);
  const auto& later = batch.results(2).contacts();
  EXPECT_TRUE(std::any_of(later.begin(), later.end(), [&](const auto& c) { return c.attached() == box_; }));
}

TEST_F(AttachedMotions, ABatchTouchesWhatEachOfItsPartsTouchesAlone) {
  const v1::CheckTrajectoryResponse batch = Ask(Batch(0, kNumMotions));
  ASSERT_OK(status_);
  ASSERT_EQ(batch.results_size(), kNumMotions);
  for (int b = 0; b < kNumMotions; ++b) {
    int num_contacts = 0;
    for (int part = 0; part <= kNumCarried; ++part) {
      SCOPED_TRACE("trajectory " + std::to_string(b) + ", part " + std::to_string(part));
      const v1::CheckTrajectoryResponse alone = Ask(OnePart(b, part));
      ASSERT_OK(status_) << ViolationOf(status_);
      ASSERT_EQ(alone.results_size(), 1);
      std::vector<v1::TrajectoryContact> of_part;
      for (const v1::TrajectoryContact& contact : batch.results(b).contacts()) {
        const bool is_sphere = contact.sphere() == 0;
        const int its = is_sphere ? kNumCarried : contact.attached() == box_ ? 1 : 0;
        if (its == part) of_part.push_back(contact);
      }
      num_contacts += static_cast<int>(of_part.size());
      ASSERT_EQ(static_cast<int>(of_part.size()), alone.results(0).contacts_size());
      for (int i = 0; i < alone.results(0).contacts_size(); ++i) {
        const v1::TrajectoryContact& expected = alone.results(0).contacts(i);
        const v1::TrajectoryContact& contact = of_part[static_cast<std::size_t>(i)];
        EXPECT_NEAR(TimeOf(contact), TimeOf(expected), 1e-5);
        EXPECT_EQ(contact.sphere(), expected.sphere());
        EXPECT_EQ(contact.attached(), expected.attached());
        EXPECT_EQ(contact.contact().submap(), expected.contact().submap());
        EXPECT_NEAR(contact.contact().depth_m(), expected.contact().depth_m(), 1e-4);
        EXPECT_NEAR(contact.contact().point_m().z(), expected.contact().point_m().z(), 1e-4);
      }
    }
    EXPECT_EQ(num_contacts, batch.results(b).contacts_size());
  }
}

TEST_F(AttachedMotions, AllContactsAreOrderedFromTheFirstAndLimitedToTheRequestedNumber) {
  v1::CheckTrajectoryRequest request = Batch(0, kNumMotions);
  const v1::CheckTrajectoryResponse all = Ask(request);
  request.set_max_contacts(2);
  const v1::CheckTrajectoryResponse two = Ask(request);
  request.set_max_contacts(0);
  request.set_all_contacts(false);
  const v1::CheckTrajectoryResponse first = Ask(request);
  request.set_packed(true);
  const v1::PackedTrajectoryResults packed = Ask(request).packed();
  ASSERT_OK(status_);
  ASSERT_EQ(all.results_size(), kNumMotions);
  ASSERT_EQ(two.results_size(), kNumMotions);
  ASSERT_EQ(first.results_size(), kNumMotions);
  ASSERT_EQ(packed.valid_size(), kNumMotions);
  for (int b = 0; b < kNumMotions; ++b) {
    const auto& contacts = all.results(b).contacts();
    EXPECT_TRUE(std::is_sorted(contacts.begin(), contacts.end(),
                               [](const auto& x, const auto& y) { return TimeOf(x) < TimeOf(y); }));
    ASSERT_EQ(two.results(b).contacts_size(), std::min(2, contacts.size()));
    ASSERT_EQ(first.results(b).contacts_size(), std::min(1, contacts.size()));
    for (int i = 0; i < two.results(b).contacts_size(); ++i) {
      EXPECT_EQ(two.results(b).contacts(i).SerializeAsString(), contacts[i].SerializeAsString());
    }
    EXPECT_EQ(packed.valid(b), contacts.empty());
    if (contacts.empty()) continue;
    EXPECT_NEAR(TimeOf(first.results(b).contacts(0)), TimeOf(contacts[0]), 1e-6);
    EXPECT_EQ(first.results(b).contacts(0).contact().submap(), contacts[0].contact().submap());
    EXPECT_EQ(packed.waypoint(b), contacts[0].waypoint());
    EXPECT_NEAR(packed.fraction(b), contacts[0].fraction(), 1e-6);
    EXPECT_EQ(packed.sphere(b), contacts[0].sphere());
    const int position = contacts[0].sphere() >= 0 ? -1 : contacts[0].attached() == box_ ? 1 : 0;
    EXPECT_EQ(packed.attached(b), position);
    EXPECT_EQ(packed.instance_id(b), contacts[0].contact().instance_id());
  }
}

TEST_F(AttachedMotions, InvalidPosesAndWrongNumbersOfPosesAreNamed) {
  struct Case {
    std::function<void(v1::CheckTrajectoryRequest&)> spoil;
    std::string violation;
  };
  constexpr int kValues = 7 * kNumMotions * kNumWaypoints * kNumCarried;
  const Case cases[] = {
      {[](auto& r) { r.mutable_packed_attached_poses()->Truncate(kValues - 1); },
       "packed_attached_poses has " + std::to_string(kValues - 1) + " values"},
      {[](auto& r) { r.mutable_packed_attached_poses()->Truncate(kValues - 7); },
       "packed_attached_poses has " + std::to_string(kValues - 7) + " values"},
      {[](auto& r) { r.mutable_packed_attached_poses()->Resize(kValues + 7, 1.f); },
       "packed_attached_poses has " + std::to_string(kValues + 7) + " values"},
      {[](auto& r) { r.mutable_options()->mutable_attached()->RemoveLast(); },
       "packed_attached_poses has " + std::to_string(kValues) + " values"},
      {[](auto& r) { r.mutable_options()->clear_attached(); },
       "packed_attached_poses has " + std::to_string(kValues) + " values"},
      {[](auto& r) { r.set_packed_attached_poses(7 * 5, NAN); }, "packed_attached_poses pose 5"},
      {[](auto& r) {
         for (int i = 3; i < 7; ++i) r.set_packed_attached_poses(7 * 4 + i, 0);
       },
       "packed_attached_poses pose 4"},
      {[](auto& r) { r.set_packed_attached_poses(7 * 3, 1e30f); }, "packed_attached_poses pose 3"},
      {[](auto& r) { r.mutable_packed_spheres_m()->Truncate(4 * kNumWaypoints * kNumMotions - 4); },
       "packed_spheres_m has " + std::to_string(4 * kNumWaypoints * kNumMotions - 4) + " values"},
      {[](auto& r) {
         r.clear_packed_spheres_m();
         r.clear_num_waypoints();
         r.clear_num_spheres();
         r.add_trajectories()->add_waypoints();
       },
       "packed_attached_poses have no meaning"},
      {[](auto& r) { r.set_packed(true); }, "all_contacts arrays"},
      {[](auto& r) { r.set_max_contacts(1001); }, "max_contacts is not"},
      {[](auto& r) { r.set_max_contacts(-1); }, "max_contacts is not"},
      {[](auto& r) {
         r.clear_all_contacts();
         r.set_max_contacts(3);
       },
       "max_contacts has no meaning"},
  };
  for (const Case& c : cases) {
    v1::CheckTrajectoryRequest request = Batch(0, kNumMotions);
    c.spoil(request);
    (void)Ask(request);
    EXPECT_EQ(status_.error_code(), grpc::INVALID_ARGUMENT) << c.violation;
    EXPECT_EQ(ViolationOf(status_).substr(0, c.violation.size()), c.violation) << ViolationOf(status_);
  }
}

}  // namespace
}  // namespace dhpmap::testing
