// SPDX-License-Identifier: BSD-3-Clause
// Things that are carried off, moved, opened and walk through, in analytic scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mapping/query/point_lookup.h"
#include "mapping/space/presence.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/pipeline/gone_scene.h"

namespace dhpmap {
namespace {

using testing::Box;
using testing::Cast;
using testing::Chair;
using testing::EmptyRoom;
using testing::FindThing;
using testing::Hit;
using testing::Info;
using testing::kChair;
using testing::kDoor;
using testing::kPeriod_ns;
using testing::kPerson;
using testing::kWall;
using testing::MapsAreEqual;
using testing::PointsOf;
using testing::Scene;
using testing::Session;
using testing::ShareWithSurface;
using testing::Solid;
using testing::WalkFrame;
using testing::With;
using testing::WithSurface;

TEST(Gone, AChairThatWasCarriedOffIsAbsentButKept) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const auto before = session.Now();
  const auto chair = WithSurface(before, PointsOf(Chair()));
  ASSERT_GT(chair.size(), 100u);
  ASSERT_NE(FindThing(*before, kChair), nullptr);
  const SubmapId id = FindThing(*before, kChair)->id();
  EXPECT_EQ(CountSurfaceVoxels(*before->Find(id)).contradicted, 0);
  EXPECT_EQ(before->Find(id)->info().last_contradicted_ns, 0);

  session.Walk(EmptyRoom(), 14);
  const auto after = session.Now();
  ASSERT_NE(after->Find(id), nullptr) << "it is kept";
  const SubmapInfo& info = after->Find(id)->info();
  EXPECT_EQ(info.presence, Presence::kAbsent);
  EXPECT_GE(info.last_contradicted_ns, 13 * kPeriod_ns);
  EXPECT_LE(info.last_observed_ns, 11 * kPeriod_ns);
  EXPECT_LE(ShareWithSurface(after, chair), 0.05);
  const PointLookup lookup(after);
  EXPECT_FALSE(lookup.At({1.45, 0.2, 0.5}).is_observed);
  EXPECT_TRUE(lookup.At({1.45, 0.2, 0.5}).is_free);
  for (const BlockEntry& entry : before->Find(id)->blocks().entries()) {
    const BlockEntry* now = after->Find(id)->blocks().Find(entry.index);
    ASSERT_NE(now, nullptr);
    EXPECT_EQ(now->tsdf->weight, entry.tsdf->weight) << "what was observed stays";
  }
}

TEST(Gone, SeenAgainAnAbsentThingIsBackAtOnce) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const SubmapId id = FindThing(*session.Now(), kChair)->id();
  const auto chair = WithSurface(session.Now(), PointsOf(Chair()));
  session.Walk(EmptyRoom(), 14);
  ASSERT_TRUE(session.map().Find(id)->IsAbsent());
  session.Walk(With(EmptyRoom(), Chair()), 1);
  const auto after = session.Now();
  EXPECT_EQ(after->Find(id)->info().presence, Presence::kPresent);
  EXPECT_EQ(FindThing(*after, kChair)->id(), id) << "the same object";
  EXPECT_GE(ShareWithSurface(after, chair), 0.99);
}

TEST(Gone, AThingThatWasMovedHasItsSurfaceAtItsNewPlaceOnly) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const auto chair = WithSurface(session.Now(), PointsOf(Chair()));
  const Solid there = Chair(1.9, 0.9);
  session.Walk(With(EmptyRoom(), there), 14);
  session.builder().Finish();
  EXPECT_LE(ShareWithSurface(session.Now(), chair), 0.05);
  std::vector<Eigen::Vector3d> seen;  // its front and its top
  for (const Eigen::Vector3d& p : PointsOf(there)) {
    if (p.x() < 1.66 || p.z() > 0.79) seen.push_back(p);
  }
  EXPECT_GE(ShareWithSurface(session.Now(), seen), 0.95);
}

TEST(Gone, WhatTakesThePlaceOfAnotherThingIsNotHeldDown) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 16);
  session.Walk(EmptyRoom(), 14);
  const Solid crate = Box(kPerson, {1.75, 0.25, 0.3}, {0.3, 0.3, 0.3});  // of another class
  session.Walk(With(EmptyRoom(), crate), 4);
  session.builder().Finish();
  const auto map = session.Now();
  EXPECT_TRUE(FindThing(*map, kChair)->IsAbsent());
  std::vector<Eigen::Vector3d> front;
  for (const Eigen::Vector3d& p : PointsOf(crate)) {
    if (p.x() < 1.46) front.push_back(p);
  }
  EXPECT_GE(ShareWithSurface(map, front), 0.95);
}

/// A wall at x = 2.4 with a doorway, through which one sees the room's wall, and a leaf that closes it or stands open.
Scene RoomWithDoor(bool is_open) {
  Scene scene = EmptyRoom();
  scene.solids.push_back(Box(kWall, {2.4, -1.9, 1.0}, {0.04, 1.7, 1.0}));
  scene.solids.push_back(Box(kWall, {2.4, 1.3, 1.0}, {0.04, 0.7, 1.0}));
  scene.solids.push_back(is_open ? Box(kDoor, {2.0, 0.62, 1.0}, {0.4, 0.03, 1.0})
                                 : Box(kDoor, {2.4, 0.2, 1.0}, {0.03, 0.4, 1.0}));
  return scene;
}

TEST(Gone, ADoorThatOpensLeavesTheDoorwayFree) {
  Session session;
  session.Walk(RoomWithDoor(false), 12);
  // Of the leaf, what is not close to where something is still: nearer than some twice the truncation nobody can tell.
  std::vector<Eigen::Vector3d> leaf, frame;
  for (double z = 0.25; z < 1.6; z += 0.05) {
    for (double y = -0.05; y < 0.41; y += 0.05) leaf.emplace_back(2.37, y, z);
    for (double y = -0.9; y < -0.3; y += 0.05) frame.emplace_back(2.36, y, z);
  }
  EXPECT_GE(ShareWithSurface(session.Now(), leaf), 0.99);
  frame = WithSurface(session.Now(), frame);
  session.Walk(RoomWithDoor(true), 14);
  const auto after = session.Now();
  EXPECT_LE(ShareWithSurface(after, leaf), 0.05);
  EXPECT_EQ(ShareWithSurface(after, frame), 1.0) << "the wall beside it stays";
  std::vector<Eigen::Vector3d> opened;
  for (double z = 0.2; z < 1.4; z += 0.1) opened.emplace_back(1.9, 0.59, z);
  EXPECT_GE(ShareWithSurface(after, opened), 0.95);
}

TEST(Gone, APersonWalkingThroughLeavesNothingBehind) {
  Session session;
  session.Walk(EmptyRoom(), 4);
  const auto person_at = [](int i) { return Box(kPerson, {1.6, -1.4 + 0.15 * i, 0.85}, {0.15, 0.2, 0.85}); };
  std::vector<Eigen::Vector3d> trail;
  for (int i = 0; i < 18; i += 2) {
    session.Walk(With(EmptyRoom(), person_at(i)), 1);
    for (const Eigen::Vector3d& p : PointsOf(person_at(i))) {
      if (std::abs(p.y()) < 1 && p.x() < 1.5 && p.z() > 0.2) trail.push_back(p);
    }
  }
  session.Walk(EmptyRoom(), 16);
  session.builder().Finish();
  const auto after = session.Now();
  EXPECT_LE(ShareWithSurface(after, trail), 0.01);
  std::vector<Eigen::Vector3d> wall;
  for (double z = 0.2; z < 1.5; z += 0.05) wall.emplace_back(3.0, 0.2, z);
  EXPECT_EQ(ShareWithSurface(after, wall), 1.0);
}

/// What a structured-light camera adds to exact depth.
void AddNoise(PanopticFrame& frame, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise;
  for (float& z : frame.camera->depth_m) {
    z += noise(random) * (0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f));
    if (random() % 50 == 0) z = 0;
  }
}

TEST(Gone, WhereNothingMovesNothingIsLost) {
  Scene scene = With(EmptyRoom(), Chair());
  scene.solids.push_back(Box(kChair, {2.2, -0.6, 0.5}, {0.03, 0.03, 0.5}));  // a post
  for (const bool is_noisy : {false, true}) {
    Session session;
    for (int i = 0; i < 20; ++i) {
      PanopticFrame frame = WalkFrame(scene, i);
      if (is_noisy) AddNoise(frame, static_cast<unsigned>(i));
      session.Take(frame);
    }
    session.builder().Finish();
    SurfaceVoxels sum;
    for (const auto& submap : session.Now()->submaps()) {
      EXPECT_FALSE(submap->IsAbsent());
      const SurfaceVoxels voxels = CountSurfaceVoxels(*submap);
      sum.all += voxels.all;
      sum.contradicted += voxels.contradicted;
    }
    EXPECT_GT(sum.all, 10'000);
    EXPECT_EQ(sum.contradicted, 0) << (is_noisy ? "with noise" : "exact");
  }
}

TEST(Gone, WhatSomebodyHasPlacedIsNeverContradicted) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const SubmapId id = FindThing(*session.Now(), kChair)->id();
  Submap& clone = *session.map().Clone(id);
  clone.mutable_info().is_placed = true;  // where it is
  const SubmapId clone_id = clone.id();
  Submap& moved = *session.map().Clone(id);
  moved.mutable_info().T_map_submap.translation().y() = 0.8;
  const SubmapId moved_id = moved.id();
  session.map().FindMutable(id)->mutable_info().is_placed = true;
  session.Walk(EmptyRoom(), 14);
  for (const SubmapId placed : {id, clone_id, moved_id}) {
    const Submap* submap = session.Now()->Find(placed);
    ASSERT_NE(submap, nullptr);
    EXPECT_FALSE(submap->IsAbsent());
    EXPECT_EQ(CountSurfaceVoxels(*submap).contradicted, 0);
    EXPECT_EQ(submap->info().last_contradicted_ns, 0);
  }
}

TEST(Gone, AnyNumberOfThreadsAndGoingOnFromASnapshotGiveTheSameBits) {
  MapInfo refined = Info();
  refined.config.refinement.every_frames = 5;
  Session one(refined, 1), four(refined, 4);
  for (Session* session : {&one, &four}) {
    session->Walk(With(EmptyRoom(), Chair()), 6);
    session->Walk(EmptyRoom(), 8);
  }
  EXPECT_TRUE(MapsAreEqual(*one.Now(), *four.Now()));

  Session through, first;
  through.Walk(With(EmptyRoom(), Chair()), 6);
  through.Walk(EmptyRoom(), 8);
  first.Walk(With(EmptyRoom(), Chair()), 6);
  first.Walk(EmptyRoom(), 2);  // counted, not yet contradicted
  MapBuilder second(first.Now(), 1);
  for (int i = 8; i < 14; ++i) ASSERT_TRUE(second.Integrate(WalkFrame(EmptyRoom(), i)).ok());
  EXPECT_TRUE(MapsAreEqual(*through.Now(), *second.map().Publish(0)));
}

TEST(Gone, WithoutItWhatWasTakenAwayStays) {
  MapInfo info = Info();
  info.config.space.gone = false;
  Session session(info);
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const auto chair = WithSurface(session.Now(), PointsOf(Chair()));
  session.Walk(EmptyRoom(), 14);
  EXPECT_EQ(ShareWithSurface(session.Now(), chair), 1.0);
  for (const auto& submap : session.Now()->submaps()) EXPECT_FALSE(submap->IsAbsent());
}

/// A scan of 64 x 720 beams.
PanopticFrame ScanFrame(const Scene& scene, const Eigen::Vector3d& eye, std::int64_t stamp_ns) {
  PanopticFrame frame;
  frame.stamp_ns = stamp_ns;
  frame.T_map_sensor.translation() = eye;
  LidarData& data = frame.lidar.emplace();
  for (int beam = 0; beam < 64; ++beam) {
    const double elevation = (-30 + 45.0 * beam / 63) * M_PI / 180;
    for (int column = 0; column < 720; ++column) {
      const double azimuth = 2 * M_PI * column / 720;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const Hit hit = Cast(scene, eye, ray);
      if (hit.solid != nullptr) data.points_m.emplace_back((hit.t * ray).cast<float>());
    }
  }
  return frame;
}

TEST(Gone, ALidarSeesThatAParkedCarHasLeft) {
  Scene street = EmptyRoom();
  street.solids[1].center_m.x() = 9;
  street.solids[2].center_m.y() = 7;
  const Solid car = Box(kChair, {4, 1, 0.7}, {1.0, 0.8, 0.7});
  MapInfo info = Info();
  info.config = OutdoorLidarConfig();
  Session session(info);
  for (int i = 0; i < 6; ++i) session.Take(ScanFrame(With(street, car), {-3 + 0.3 * i, 0, 1.7}, i * kPeriod_ns));
  const double voxel_m = info.config.voxel_size_m;
  const auto share = [&](const std::vector<Eigen::Vector3d>& points) {
    SurfaceCache cache(std::size_t{1} << 28);
    const auto map = session.Now();
    const DistanceQuery query(cache.Of(map), {.max_distance_m = 1.0});
    const auto has = [&](const Eigen::Vector3d& p) { return std::abs(query.At(p).distance_m) <= voxel_m; };
    return static_cast<double>(std::count_if(points.begin(), points.end(), has)) / static_cast<double>(points.size());
  };
  std::vector<Eigen::Vector3d> side, wall;
  for (double z = 0.8; z < 1.3; z += 0.1) {
    for (double y = 0.4; y < 1.7; y += 0.1) side.emplace_back(3, y, z);
    for (double x = 0; x < 6; x += 0.2) wall.emplace_back(x, 7, z);
  }
  EXPECT_GE(share(side), 0.99);
  const double wall_before = share(wall);
  for (int i = 6; i < 14; ++i) session.Take(ScanFrame(street, {-3 + 0.3 * i, 0, 1.7}, i * kPeriod_ns));
  EXPECT_LE(share(side), 0.05);
  EXPECT_GE(share(wall), wall_before);
}

}  // namespace
}  // namespace dhpmap
