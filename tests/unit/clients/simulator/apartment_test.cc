// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/apartment.h"

#include <gtest/gtest.h>

#include <set>

#include "clients/simulator/camera_path.h"
#include "clients/simulator/instance_views.h"
#include "clients/simulator/renderer.h"
#include "tests/unit/clients/simulator/recorded_apartment.h"

namespace dhpmap::simulator {
namespace {

using testing::Apartment;

TEST(Apartment, HasManyThingsOfManyClassesInFiveRooms) {
  std::set<ObjectClass> classes;
  std::set<std::string> names;
  int num_things = 0;
  for (const Instance& instance : Apartment().instances()) {
    EXPECT_TRUE(names.insert(instance.name).second) << instance.name;
    if (!InfoOf(instance.object_class).is_thing) continue;
    ++num_things;
    classes.insert(instance.object_class);
  }
  EXPECT_GE(num_things, 25);
  EXPECT_GE(classes.size(), 12u);
  EXPECT_GE(ApartmentScene::Rooms().size(), 4u);
}

TEST(Apartment, IdsAreIndicesAndFitAPixel) {
  const auto instances = Apartment().instances();
  ASSERT_LE(instances.size(), 256u);
  for (std::size_t i = 0; i < instances.size(); ++i) EXPECT_EQ(instances[i].id, i);
}

TEST(Apartment, EverySolidIsFoundAtItsOwnSurface) {
  for (const Solid& solid : Apartment().solids()) {
    // Straight above the middle: on the surface, unless something else stands there.
    const Ray ray{solid.center_m + Eigen::Vector3d(0, 0, 2 * kRoomHeight_m), -Eigen::Vector3d::UnitZ()};
    const std::optional<double> t = solid.Intersect(ray, kFar_m);
    if (!t) continue;  // the middle of a ring is empty
    const Eigen::Vector3d p = ray.At(*t);
    EXPECT_NEAR(solid.Distance(p), 0, 1e-5);
    EXPECT_LE(Apartment().Distance(p), 1e-5);
  }
}

TEST(Apartment, DistanceIsThatToTheNearestSolid) {
  for (const Room& room : ApartmentScene::Rooms()) {
    for (double share : {0.2, 0.45, 0.7}) {
      const Eigen::Vector3d p(room.min_x_m + share * (room.max_x_m - room.min_x_m),
                              room.min_y_m + (1 - share) * (room.max_y_m - room.min_y_m), 0.3 + 2 * share);
      double nearest_m = kFar_m;
      std::uint8_t nearest = 0;
      for (const Solid& solid : Apartment().solids()) {
        if (solid.Distance(p) >= nearest_m) continue;
        nearest_m = solid.Distance(p);
        nearest = solid.instance;
      }
      EXPECT_NEAR(Apartment().Distance(p), nearest_m, 1e-9) << room.name;
      EXPECT_EQ(Apartment().InstanceAt(p), nearest) << room.name;
    }
  }
}

TEST(CameraPath, KeepsItsDistanceFromEverything) {
  const CameraPath path;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d eye = path.PoseAt(i / 4000.0).translation();
    ASSERT_GE(Apartment().Distance(eye), CameraPath::kClearance_m)
        << "at " << eye.transpose() << " near " << Apartment().instances()[Apartment().InstanceAt(eye)].name;
    EXPECT_NEAR(eye.z(), 1.4, 0.1);
  }
}

TEST(CameraPath, IsSmoothAndEndsWhereItBegan) {
  const CameraPath path;
  constexpr int kFrames = 1200;
  Transform before = path.PoseOfFrame(kFrames - 1, kFrames);
  for (int i = 0; i < kFrames; ++i) {
    const Transform T = path.PoseOfFrame(i, kFrames);
    EXPECT_LT((T.translation() - before.translation()).norm(), 0.08) << i;
    const Eigen::AngleAxisd turn(before.linear().transpose() * T.linear());
    EXPECT_LT(turn.angle(), 0.12) << i;
    EXPECT_NEAR(T.linear().determinant(), 1, 1e-9);
    EXPECT_LT(T.linear().col(1).z(), 0) << "the image's y points down";
    before = T;
  }
}

TEST(CameraPath, GoesThroughEveryRoom) {
  const CameraPath path;
  std::set<std::string> seen;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d eye = path.PoseAt(i / 400.0).translation();
    for (const Room& room : ApartmentScene::Rooms()) {
      if (eye.x() > room.min_x_m && eye.x() < room.max_x_m && eye.y() > room.min_y_m && eye.y() < room.max_y_m) {
        seen.insert(room.name);
      }
    }
  }
  EXPECT_EQ(seen.size(), ApartmentScene::Rooms().size());
}

TEST(CameraPath, SeesMostThingsWellInThreeFramesOrMore) {
  constexpr int kFrames = 120;
  const Renderer renderer(Apartment(), Renderer::Output::kGeometry);
  const CameraPath path;
  std::vector<InstanceView> views(Apartment().instances().size());
  for (int i = 0; i < kFrames; ++i) {
    const RenderedFrame frame = renderer.Render(FlatLayoutCamera(160, 120), path.PoseOfFrame(i, kFrames));
    const std::vector<InstanceView> of_frame = ViewsOfInstances(frame, views.size());
    for (std::size_t id = 0; id < views.size(); ++id) views[id].Join(of_frame[id]);
  }
  int num_seen = 0, num_things = 0;
  std::string unseen;
  for (const Instance& instance : Apartment().instances()) {
    if (!InfoOf(instance.object_class).is_thing) continue;
    ++num_things;
    views[instance.id].num_frames >= 3 ? void(++num_seen) : void(unseen += " " + instance.name);
  }
  EXPECT_GE(num_seen, 25);
  EXPECT_GE(num_seen, 0.9 * num_things) << "of " << num_things << ", not:" << unseen;
}

}  // namespace
}  // namespace dhpmap::simulator
