// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/map_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mapping/query/point_lookup.h"
#include "tests/support/map_equality.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::LookAt;
using testing::MapsAreEqual;
using testing::Render;
using testing::Scene;
using testing::SmallCamera;
using testing::Solid;

constexpr ClassId kRoomBall{1}, kRoomCrate{2}, kRoomFloor{3};
constexpr std::uint32_t kBallSegment = 11, kCrateSegment = 12, kFloorSegment = 13;
constexpr std::int64_t kFramePeriod_ns = 100'000'000;

Scene RoomScene() {
  return {{{.shape = Solid::Shape::kSphere,
            .center_m = {2, -0.6, 0.4},
            .size_m = {0.4, 0, 0},
            .segment = kBallSegment,
            .color = {200, 0, 0}},
           {.shape = Solid::Shape::kBox,
            .center_m = {2.2, 0.6, 0.3},
            .size_m = {0.3, 0.3, 0.3},
            .segment = kCrateSegment,
            .color = {0, 200, 0}},
           {.shape = Solid::Shape::kHalfSpace,
            .center_m = {0, 0, 0},
            .size_m = {0, 0, 1},
            .segment = kFloorSegment,
            .color = {90, 90, 90}}}};
}

MapInfo RoomInfo() {
  MapInfo info = testing::NamedMap("room", 2, 1);
  info.config.tracking.min_points_stuff = 100;
  info.config.tracking.min_points_medium = 50;
  return info;
}

/// RoomFrame `i` of a walk around the room; segment ids are permuted from frame to frame, as a network's would be.
PanopticFrame RoomFrame(const Scene& scene, int i) {
  const Eigen::Vector3d eye(-0.2 + 0.03 * i, -0.8 + 0.11 * i, 1.2);
  PanopticFrame frame = Render(scene, SmallCamera(), LookAt(eye, {2.1, 0.02, 0.3}));
  frame.stamp_ns = i * kFramePeriod_ns;
  const std::uint32_t shift = static_cast<std::uint32_t>(i % 3) * 100;
  for (std::uint32_t& id : frame.camera->segments) {
    if (id != 0) id += shift;
  }
  frame.segments = {{.id = SegmentId(kBallSegment + shift), .class_id = kRoomBall},
                    {.id = SegmentId(kCrateSegment + shift), .class_id = kRoomCrate},
                    {.id = SegmentId(kFloorSegment + shift), .class_id = kRoomFloor}};
  return frame;
}

std::shared_ptr<const MapSnapshot> MapRoom(int num_frames, int num_threads, int publish_every = 0) {
  MapBuilder builder(RoomInfo(), num_threads);
  for (int i = 0; i < num_frames; ++i) {
    EXPECT_TRUE(builder.Integrate(RoomFrame(RoomScene(), i)).ok());
    if (publish_every > 0 && i % publish_every == 0) builder.map().Publish(0);
  }
  return builder.map().Publish(0);
}

TEST(MapBuilder, OneSubmapAnObjectThoughSegmentIdsChange) {
  const auto map = MapRoom(8, 2);
  ASSERT_EQ(map->submaps().size(), 4u);
  const PointLookup lookup(map);
  const PointInfo ball = lookup.At({1.62, -0.6, 0.5});
  const PointInfo crate = lookup.At({1.9, 0.5, 0.45});
  const PointInfo floor = lookup.At({1.5, 0.0, 0.0});
  ASSERT_TRUE(ball.is_observed && crate.is_observed && floor.is_observed);
  EXPECT_EQ(ball.class_id, kRoomBall);
  EXPECT_EQ(crate.class_id, kRoomCrate);
  EXPECT_EQ(floor.class_id, kRoomFloor);
  EXPECT_EQ(floor.panoptic, Panoptic::kStuff);
  EXPECT_NE(ball.submap, crate.submap);
  EXPECT_FALSE(lookup.At({1.0, 0.0, 1.0}).is_observed);
}

TEST(MapBuilder, AnyNumberOfThreadsGivesTheSameBits) {
  const auto one = MapRoom(6, 1);
  EXPECT_TRUE(MapsAreEqual(*one, *MapRoom(6, 2)));
  EXPECT_TRUE(MapsAreEqual(*one, *MapRoom(6, 5)));
}

TEST(MapBuilder, KeepsWhatWasLookedThroughUnlessTheConfigSaysNo) {
  const auto map = MapRoom(3, 2);
  EXPECT_TRUE(map->free_space()->IsFree(VoxelAt({1.0, 0.0, 1.0}, map->info().config.voxel_size_m)));
  EXPECT_FALSE(map->free_space()->IsFree(VoxelAt({1.0, 0.0, -0.2}, map->info().config.voxel_size_m)));
  MapInfo info = RoomInfo();
  info.config.space.free = info.config.space.gone = false;
  MapBuilder builder(info, 1);
  const auto report = builder.Integrate(RoomFrame(RoomScene(), 0));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->free_s, 0);
  EXPECT_TRUE(builder.map().free_space().empty());
}

TEST(MapBuilder, PublishingInBetweenChangesNothing) { EXPECT_TRUE(MapsAreEqual(*MapRoom(6, 1), *MapRoom(6, 1, 1))); }

TEST(MapBuilder, GoingOnFromASnapshotEqualsMappingInOneGo) {
  MapBuilder second(MapRoom(4, 2), 2);
  for (int i = 4; i < 8; ++i) ASSERT_TRUE(second.Integrate(RoomFrame(RoomScene(), i)).ok());
  EXPECT_TRUE(MapsAreEqual(*MapRoom(8, 2), *second.map().Publish(0)));
}

TEST(MapBuilder, SnapshotsDoNotChangeWhileMappingGoesOn) {
  MapBuilder builder(RoomInfo(), 2);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(builder.Integrate(RoomFrame(RoomScene(), i)).ok());
  const auto snapshot = builder.map().Publish(0);
  const auto untouched = MapRoom(3, 1);
  for (int i = 3; i < 6; ++i) ASSERT_TRUE(builder.Integrate(RoomFrame(RoomScene(), i)).ok());
  EXPECT_TRUE(MapsAreEqual(*snapshot, *untouched));
}

TEST(MapBuilder, RefusedFrameChangesNothing) {
  MapBuilder builder(RoomInfo(), 1);
  ASSERT_TRUE(builder.Integrate(RoomFrame(RoomScene(), 0)).ok());
  const auto before = builder.map().Publish(0);
  PanopticFrame bad = RoomFrame(RoomScene(), 1);
  bad.T_map_sensor.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(builder.Integrate(bad).status().code(), StatusCode::kInvalidArgument);
  bad = RoomFrame(RoomScene(), 1);
  bad.segments[0].class_id = ClassId(99);
  EXPECT_EQ(builder.Integrate(bad).status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(builder.map().Publish(0), before);
}

TEST(MapBuilder, FrameWithoutLabelsGoesToTheUnknownSubmap) {
  MapBuilder builder(RoomInfo(), 1);
  PanopticFrame frame = RoomFrame(RoomScene(), 0);
  frame.segments.clear();
  frame.camera->segments.clear();
  const auto report = builder.Integrate(frame);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->num_unknown_points, report->num_points);
  const auto map = builder.map().Publish(0);
  EXPECT_EQ(map->submaps().size(), 1u);
  const PointInfo floor = PointLookup(map).At({1.5, 0, 0});
  EXPECT_TRUE(floor.is_observed);
  EXPECT_EQ(floor.submap, kUnknownSubmap);
  EXPECT_EQ(floor.panoptic, Panoptic::kUnknown);
}

TEST(MapBuilder, PersistentIdsNeedNoOverlap) {
  MapBuilder builder(RoomInfo(), 1);
  for (int i = 0; i < 2; ++i) {
    // The ball jumps: no overlap between its two places.
    Scene scene = RoomScene();
    scene.solids[0].center_m.y() -= 1.0 * i;
    PanopticFrame frame = RoomFrame(scene, 0);
    frame.has_persistent_ids = true;
    ASSERT_TRUE(builder.Integrate(frame).ok());
  }
  EXPECT_EQ(builder.map().Publish(0)->submaps().size(), 4u);
}

TEST(MapBuilder, MovedObjectTakesNewObservationsAtItsNewPlace) {
  MapBuilder builder(RoomInfo(), 1);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(builder.Integrate(RoomFrame(RoomScene(), i)).ok());
  const SubmapId ball = PointLookup(builder.map().Publish(0)).At({1.62, -0.6, 0.5}).submap;
  // A user moves the ball's submap by a distance that is no multiple of the voxel, and the ball follows.
  const Eigen::Vector3d shift_m(0.013, -0.537, 0.0);
  builder.map().FindMutable(ball)->mutable_info().T_map_submap.translation() = shift_m;
  Scene scene = RoomScene();
  scene.solids[0].center_m += shift_m;
  for (int i = 4; i < 8; ++i) ASSERT_TRUE(builder.Integrate(RoomFrame(scene, i)).ok());
  const auto map = builder.map().Publish(0);
  EXPECT_EQ(map->submaps().size(), 4u);
  const PointInfo moved = PointLookup(map).At(Eigen::Vector3d(1.62, -0.6, 0.5) + shift_m);
  EXPECT_EQ(moved.submap, ball);
  EXPECT_GT(moved.weight, 0.0f);
  EXPECT_EQ(map->Find(ball)->info().num_frames_observed, 8);
}

TEST(MapBuilder, SphereEnclosesEveryObservedVoxel) {
  const auto map = MapRoom(6, 2);
  for (const auto& submap : map->submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!entry.tsdf->IsObserved(i)) continue;
        const Eigen::Vector3d centre = VoxelCentre(VoxelIn(entry.index, i), submap->info().voxel_size_m);
        ASSERT_TRUE(submap->bounding_sphere().Contains(centre));
      }
    }
  }
}

TEST(MapBuilder, PointsOnAllSidesOfTheSensorLeaveNoNonsense) {
  MapInfo info = testing::NamedMap("m", 1, 1);
  info.config.voxel_size_m = 0.5;
  info.config.truncation_m = 1.0;
  MapBuilder builder(info, 1);
  PanopticFrame frame;
  frame.T_map_sensor.translation() = Eigen::Vector3d(-1.25, 0.25, 0.25);
  frame.lidar.emplace().points_m = {{0.2f, 0, 0}, {-0.2f, 0, 0}};  // their mean is where the sensor stands
  ASSERT_TRUE(builder.Integrate(frame).ok());
  ASSERT_FALSE(builder.map().submaps().empty());
  for (const auto& submap : builder.map().submaps()) {
    EXPECT_LT(submap->bounding_sphere().radius_m, 5);
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; entry.tsdf != nullptr && i < kBlockVoxels; ++i) {
        EXPECT_TRUE(std::isfinite(entry.tsdf->distance_m[static_cast<std::size_t>(i)]));
      }
    }
  }
}

}  // namespace
}  // namespace dhpmap
