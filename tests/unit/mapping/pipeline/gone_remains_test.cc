// SPDX-License-Identifier: BSD-3-Clause
// What is left of things that are gone, in analytic scenes: nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "mapping/space/free_space_finder.h"
#include "mapping/space/presence.h"
#include "tests/unit/mapping/pipeline/gone_scene.h"

namespace dhpmap {
namespace {

using testing::Box;
using testing::Chair;
using testing::EmptyRoom;
using testing::FindThing;
using testing::Info;
using testing::kChair;
using testing::kDoor;
using testing::PointsOf;
using testing::Scene;
using testing::Session;
using testing::ShareWithSurface;
using testing::Solid;
using testing::With;
using testing::WithSurface;

TEST(GoneRemains, NothingIsLeftOfTheFootOfWhatStoodOnTheFloor) {
  const Solid plinth = Box(kDoor, {1.7, 0.2, 0.3}, {0.25, 0.25, 0.3});  // stuff: never absent as a whole
  for (const double truncation_m : {0.08, 0.16}) {
    MapInfo info = Info();
    info.config.truncation_m = truncation_m;
    Session session(info);
    session.Walk(With(EmptyRoom(), plinth), 12);
    std::vector<Eigen::Vector3d> foot;
    for (const Eigen::Vector3d& p : PointsOf(plinth)) {
      if (p.z() > 0.13 && p.z() < 0.25) foot.push_back(p);
    }
    foot = WithSurface(session.Now(), foot);
    ASSERT_GT(foot.size(), 10u);
    session.Walk(EmptyRoom(), 14);
    EXPECT_EQ(WithSurface(session.Now(), foot).size(), 0u) << truncation_m;
  }
}

TEST(GoneRemains, FragmentsOfOtherObjectsGoWithWhatTheyStuckTo) {
  // Spots of another class, one or two voxels wide and one to a block: alone they would be too few to count.
  Scene scene = With(EmptyRoom(), Chair());
  std::vector<Eigen::Vector3d> spots;
  for (const double y : {0.06, 0.34}) {
    for (const double z : {0.16, 0.48, 0.66}) {
      spots.emplace_back(1.45, y, z);
      scene.solids.push_back(Box(kDoor, {1.455, y, z}, {0.01, 0.02, 0.02}));
    }
  }
  MapInfo info = Info();
  info.config.tracking.min_points_stuff = 1;
  Session session(info);
  session.Walk(scene, 12);
  const auto before = session.Now();
  EXPECT_EQ(WithSurface(before, spots).size(), spots.size());
  const auto of_spots = [](const MapSnapshot& map) {
    SurfaceVoxels voxels;
    for (const auto& submap : map.submaps()) {
      if (submap->info().class_id == kDoor) voxels = CountSurfaceVoxels(*submap);
    }
    return voxels;
  };
  ASSERT_GT(of_spots(*before).all, 6);
  ASSERT_LT(of_spots(*before).all, 60);
  session.Walk(EmptyRoom(), 14);
  EXPECT_EQ(of_spots(*session.Now()).contradicted, of_spots(*session.Now()).all);
  EXPECT_EQ(WithSurface(session.Now(), spots).size(), 0u);
}

TEST(GoneRemains, SensorsThatTakeTurnsHideNothingFromEachOther) {
  // Three cameras, of which one sees the chair: its frames are always the first, second or third of three.
  for (int place = 0; place < 3; ++place) {
    Session session;
    const auto walk = [&](const Scene& scene, int first, int last) {
      for (int i = first; i < last; ++i) {
        for (int camera = 0; camera < 3; ++camera) {
          PanopticFrame frame = WalkFrame(scene, i);
          if (camera != place) {
            std::fill(frame.camera->depth_m.begin(), frame.camera->depth_m.end(), 0.0f);
            std::fill(frame.camera->segments.begin(), frame.camera->segments.end(), 0u);
          }
          session.Take(frame);
        }
      }
    };
    walk(With(EmptyRoom(), Chair()), 0, 12);
    const auto chair = WithSurface(session.Now(), PointsOf(Chair()));
    ASSERT_GT(chair.size(), 100u);
    walk(EmptyRoom(), 12, 36);
    EXPECT_LE(ShareWithSurface(session.Now(), chair), 0.05) << place;
  }
}

TEST(GoneRemains, PresenceIsTheSameBeforeAndAfterTheEndOfMapping) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const SubmapId id = FindThing(*session.Now(), kChair)->id();
  for (int i = 0; i < 16; ++i) {
    session.Walk(EmptyRoom(), 1);
    const bool is_settled = session.map().Find(id)->info().activity == Activity::kInactive;
    const bool is_absent = session.map().Find(id)->IsAbsent();
    UpdatePresenceOfAll(session.map());
    if (is_settled) {
      EXPECT_EQ(session.map().Find(id)->IsAbsent(), is_absent) << i;
    }
  }
  EXPECT_TRUE(session.map().Find(id)->IsAbsent());
}

/// A board that hides the lower part of where the chair is.
Scene WithBoard(const Scene& scene) { return With(scene, Box(kDoor, {1.2, 0.2, 0.35}, {0.03, 1.2, 0.35})); }

TEST(GoneRemains, AThingNobodySeesAnyLongerIsAbsentWhenAPartOfItsPlaceIsLookedThrough) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const SubmapId id = FindThing(*session.Now(), kChair)->id();
  session.Walk(WithBoard(EmptyRoom()), 14);
  const auto after = session.Now();
  const SurfaceVoxels voxels = CountSurfaceVoxels(*after->Find(id));
  EXPECT_LT(static_cast<double>(voxels.contradicted), kAbsentShare * static_cast<double>(voxels.all));
  EXPECT_TRUE(after->Find(id)->IsAbsent());
}

TEST(GoneRemains, AThingOfWhichAPartIsGoneIsThereWhileTheRestIsSeen) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const SubmapId id = FindThing(*session.Now(), kChair)->id();
  const Solid low = Box(kChair, {1.7, 0.2, 0.25}, {0.25, 0.25, 0.25});
  session.Walk(With(EmptyRoom(), low), 14);
  const auto after = session.Now();
  const SurfaceVoxels voxels = CountSurfaceVoxels(*after->Find(id));
  EXPECT_GT(static_cast<double>(voxels.contradicted), kAbsentShareUnseen * static_cast<double>(voxels.all));
  EXPECT_FALSE(after->Find(id)->IsAbsent());
}

TEST(GoneRemains, AFewLooksInARowAreEnoughForWhatIsNotSeenWhereItWas) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const auto chair = WithSurface(session.Now(), PointsOf(Chair()));
  session.Walk(EmptyRoom(), 4);
  EXPECT_LE(ShareWithSurface(session.Now(), chair), 0.05);
}

const ClassId kNobody{0};  // of no prediction

TEST(GoneRemains, WhatNoPredictionNamedOfAThingLeavesWithIt) {
  const Solid back = Box(kNobody, {1.9, 0.2, 1.0}, {0.04, 0.25, 0.2});
  Session session;
  session.Walk(With(With(EmptyRoom(), Chair()), back), 12);
  const auto of_back = WithSurface(session.Now(), PointsOf(back));
  ASSERT_GT(of_back.size(), 30u);
  session.Walk(EmptyRoom(), 2);
  EXPECT_LE(ShareWithSurface(session.Now(), of_back), 0.2) << "two looks";
}

/// A chair that no prediction names.
Scene RoomWithOverlookedChair() {
  Solid overlooked = Chair();
  overlooked.segment = kNobody.value;
  return With(EmptyRoom(), overlooked);
}

/// A nameless crate stands beside the chair for a while, then is gone for one frame, which overlooks the chair. Returns
/// points of the crate that had a surface.
std::vector<Eigen::Vector3d> TakeCrateAwayFromOverlookedChair(Session& session) {
  const Solid crate = Box(kNobody, {1.9, 0.2, 1.0}, {0.04, 0.25, 0.2});
  session.Walk(With(With(EmptyRoom(), Chair()), crate), 12);
  std::vector<Eigen::Vector3d> of_crate = WithSurface(session.Now(), PointsOf(crate));
  EXPECT_GT(of_crate.size(), 30u);
  session.Walk(RoomWithOverlookedChair(), 1);
  return of_crate;
}

TEST(GoneRemains, WhatIsNamelessBesideAThingThatIsOnlyOverlookedIsLookedThroughMoreThanOnce) {
  Session session;
  const auto of_crate = TakeCrateAwayFromOverlookedChair(session);
  EXPECT_GE(ShareWithSurface(session.Now(), of_crate), 0.99);
  session.Walk(RoomWithOverlookedChair(), 5);
  EXPECT_LE(ShareWithSurface(session.Now(), of_crate), 0.3);
}

TEST(GoneRemains, WhatNobodyHasNamedIsGoneAfterTwoLooksThroughMuchOfIt) {
  Solid nameless = Chair();
  nameless.segment = kNobody.value;
  Session session;
  session.Walk(With(EmptyRoom(), nameless), 12);
  std::vector<Eigen::Vector3d> front;  // of which what lies behind it is seen, far enough
  for (const Eigen::Vector3d& p : PointsOf(nameless)) {
    if (p.x() < 1.46 && p.z() > 0.3) front.push_back(p);
  }
  front = WithSurface(session.Now(), front);
  ASSERT_GT(front.size(), 40u);
  session.Walk(EmptyRoom(), 1);
  EXPECT_GE(ShareWithSurface(session.Now(), front), 0.9);
  session.Walk(EmptyRoom(), 1);
  EXPECT_LE(ShareWithSurface(session.Now(), front), 0.1);
}

TEST(GoneRemains, WhatAThingLostLongAgoTakesNothingWithItAtOnce) {
  const Solid back = Box(kChair, {1.5, 0.2, 1.0}, {0.04, 0.25, 0.2});
  Session session;
  session.Walk(With(With(EmptyRoom(), Chair()), back), 12);
  session.Walk(With(EmptyRoom(), Chair()), 14);
  const auto before = session.Now();
  const Submap* chair = FindThing(*before, kChair);
  ASSERT_NE(chair, nullptr);
  ASSERT_GT(CountSurfaceVoxels(*chair).contradicted, 50);
  session.next_ += 1200;  // two minutes
  const auto of_crate = TakeCrateAwayFromOverlookedChair(session);
  EXPECT_GE(ShareWithSurface(session.Now(), of_crate), 0.99);
}

TEST(GoneRemains, ChangedSubmapsAreToldByAscendingIdTheUnknownOneFirst) {
  const Solid back = Box(kNobody, {1.9, 0.2, 1.0}, {0.04, 0.25, 0.2});
  Session session;
  session.Walk(With(With(EmptyRoom(), Chair()), back), 12);
  ThreadPool pool(1);
  const auto changed = FreeSpaceFinder().Look(testing::WalkFrame(EmptyRoom(), 13), session.map(), pool);
  ASSERT_GE(changed.size(), 2u);
  EXPECT_EQ(changed.front(), kUnknownSubmap);
  EXPECT_TRUE(std::is_sorted(changed.begin(), changed.end()));
}

TEST(GoneRemains, StampsMayBeAsFarApartAsTheyCan) {
  Session session;
  session.Walk(With(EmptyRoom(), Chair()), 12);
  const auto chair = WithSurface(session.Now(), PointsOf(Chair()));
  for (int i = 0; i < 14; ++i) {
    PanopticFrame frame = WalkFrame(EmptyRoom(), 12 + i);
    frame.stamp_ns = (i % 2 == 0 ? -1 : 1) * ((std::int64_t{1} << 62) - 1);
    session.Take(frame);
  }
  EXPECT_LE(ShareWithSurface(session.Now(), chair), 0.05);
}

/// Looks through all blocks of a submap at this height so often, last at `stamp_ns`.
void LookThrough(std::int32_t height, int times, std::int64_t stamp_ns, Submap& submap) {
  VoxelMask all;
  all.fill(~std::uint64_t{0});
  std::vector<BlockIndex> blocks;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    if (entry.index.z == height) blocks.push_back(entry.index);
  }
  for (const BlockIndex block : blocks) {
    for (int i = 0; i < times; ++i) submap.MutableGone(block).Raise(all, {.position_m = {}, .stamp_ns = stamp_ns});
  }
}

TEST(GoneRemains, WhatWasContradictedBeforeAThingWasLastSeenSaysNothingOfWhereItIs) {
  constexpr std::int64_t kSeen_ns = 50'000'000'000, kLater_ns = 60'000'000'000;
  for (const bool is_before : {true, false}) {
    Session session;
    session.Walk(With(EmptyRoom(), Chair()), 12);
    Submap& chair = *session.map().FindMutable(FindThing(*session.Now(), kChair)->id());
    chair.mutable_info().activity = Activity::kInactive;
    chair.mutable_info().last_observed_ns = kSeen_ns;
    LookThrough(0, GoneBlock::kContradicted, is_before ? kSeen_ns - 1 : kLater_ns, chair);
    LookThrough(1, GoneBlock::kContradicted - 1, kLater_ns, chair);
    const SurfaceVoxels voxels = CountSurfaceVoxels(chair);
    ASSERT_LT(static_cast<double>(voxels.contradicted), kAbsentShare * static_cast<double>(voxels.all));
    ASSERT_GT(static_cast<double>(voxels.contradicted), kMovedShare * static_cast<double>(voxels.all));
    ASSERT_GT(static_cast<double>(voxels.doubted_unseen), kAbsentShareUnseen * static_cast<double>(voxels.all));
    EXPECT_EQ(voxels.settled, is_before ? voxels.contradicted : 0);
    UpdatePresenceOfAll(session.map());
    EXPECT_EQ(chair.IsAbsent(), !is_before) << "it was moved, and is where it was seen";
  }
}

}  // namespace
}  // namespace dhpmap
