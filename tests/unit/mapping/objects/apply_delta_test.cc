// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/apply_delta.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "mapping/objects/merge_submaps.h"
#include "mapping/paging/tile_page.h"
#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

MapInfo MapOfClasses() { return testing::NamedMap("m", 3, 1); }

SubmapId AddChair(Map& map) { return map.Create(testing::InfoOn(map, Panoptic::kThing, ClassId(1))).id(); }

StateDelta Difference(const MapSnapshot& before, const MapSnapshot& after) {
  StateDelta delta = DiffRows(before, after);
  AddTiles(before, after, delta);
  return delta;
}

/// A store of which nothing can be read.
class NoTiles final : public TileSource {
 public:
  Result<std::vector<BlockEntry>> Read(const TileOnDisk& /*tile*/) override { return Unavailable("the disk is away"); }
};

TEST(ApplyDelta, ASphereIsPutBackWithoutReadingTheVoxelsInIt) {
  Map map(MapOfClasses());
  const SubmapId id = AddChair(map);
  const TileOnDisk on_disk{.index = {0, 0, 0}, .cells = {0b1011, 0, 0}, .keys = {7, 0, 0}, .store = 1};
  Submap& chair = *map.FindMutable(id);
  chair.PutTile(on_disk.index, std::make_shared<const BlockTile>(
                                   std::make_shared<const TilePage>(on_disk, std::make_shared<NoTiles>())));
  chair.UpdateBoundingSphere();
  map.Publish(1);
  const Submap& now = *map.Find(id);
  BoundingSphere larger = now.bounding_sphere();
  larger.radius_m *= 2;
  StateDelta delta;
  delta.submaps.push_back({.id = id,
                           .before = SubmapRowState{now.info(), larger},
                           .after = SubmapRowState{now.info(), now.bounding_sphere()},
                           .tiles = {}});
  ASSERT_TRUE(ApplyDelta(delta, DeltaSide::kBefore, map).ok());
  EXPECT_EQ(map.Find(id)->bounding_sphere().radius_m, larger.radius_m);
}

TEST(ApplyDelta, WhatComesBackKeepsTracksThatNobodyElseHasFound) {
  Map map(MapOfClasses());
  const SubmapId id = AddChair(map);
  SubmapInfo& info = map.FindMutable(id)->mutable_info();
  info.track_id = 5;
  info.sightings.OnSeen("left", 1);
  info.sightings.SetTrack("left", 7);
  info.sightings.SetTrack("right", 7);
  const auto before = map.Publish(1);
  map.Remove(id);
  const auto after = map.Publish(2);
  // The front end of the left robot sees the thing again: for the map it is another one.
  map.FindMutable(AddChair(map))->mutable_info().sightings.SetTrack("left", 7);

  ASSERT_TRUE(ApplyDelta(Difference(*before, *after), DeltaSide::kBefore, map).ok());
  const Submap* back = map.Find(id);
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->info().sightings.TrackOf("left"), 0u);
  EXPECT_TRUE(back->info().sightings.IsInSightOf("left"));
  EXPECT_EQ(back->info().sightings.TrackOf("right"), 7u);
  EXPECT_EQ(back->info().track_id, 5u);
}

TEST(ApplyDelta, SightingsComeBackUnlessFramesHaveChangedThem) {
  Map map(MapOfClasses());
  const SubmapId untouched = AddChair(map), seen = AddChair(map);
  const auto before = map.Publish(1);
  for (const SubmapId id : {untouched, seen}) {
    map.FindMutable(id)->mutable_info().sightings.SetTrack("left", id.value);  // as a merge does
  }
  const auto after = map.Publish(2);
  map.FindMutable(seen)->mutable_info().sightings.OnSeen("right", 9);

  ASSERT_TRUE(ApplyDelta(Difference(*before, *after), DeltaSide::kBefore, map).ok());
  EXPECT_EQ(map.Find(untouched)->info().sightings, Sightings());
  EXPECT_EQ(map.Find(seen)->info().sightings.TrackOf("left"), seen.value);
  EXPECT_TRUE(map.Find(seen)->info().sightings.IsInSightOf("right"));
}

TEST(ApplyDelta, AnIdThatAnotherSessionHasGivenToAnotherThingIsNoHindrance) {
  Map map(MapOfClasses());
  const SubmapId id = AddChair(map), other = AddChair(map);
  for (const auto& [thing, session] : {std::pair(id, "left"), std::pair(other, "right")}) {
    SubmapInfo& info = map.FindMutable(thing)->mutable_info();
    info.track_id = 7;
    info.sightings.SetTrack(session, 7);
  }
  const auto before = map.Publish(1);
  map.Remove(id);
  const auto after = map.Publish(2);
  ASSERT_TRUE(ApplyDelta(Difference(*before, *after), DeltaSide::kBefore, map).ok());
  EXPECT_EQ(map.Find(id)->info().sightings.TrackOf("left"), 7u);
  EXPECT_EQ(map.Find(id)->info().track_id, 7u);
}

TEST(ApplyDelta, WhatHasLostAllOfItsTracksIsNoSessionsAnyLonger) {
  Map map(MapOfClasses());
  const SubmapId id = AddChair(map);
  map.FindMutable(id)->mutable_info().track_id = 7;
  map.FindMutable(id)->mutable_info().sightings.SetTrack("left", 7);
  const auto before = map.Publish(1);
  map.Remove(id);
  const auto after = map.Publish(2);
  map.FindMutable(AddChair(map))->mutable_info().sightings.SetTrack("left", 7);
  ASSERT_TRUE(ApplyDelta(Difference(*before, *after), DeltaSide::kBefore, map).ok());
  EXPECT_EQ(map.Find(id)->info().track_id, 0u) << "else it would be that of any session";
}

/// What somebody has merged, into the older or the later one, is seen once more, and then two again.
class UndoneMerge : public ::testing::TestWithParam<bool> {};

TEST_P(UndoneMerge, GivesEachItsIdsBackThoughFramesHaveSeenTheWholeAndDoneAgainTakesThem) {
  Map map(MapOfClasses());
  const SubmapId first = AddChair(map), second = AddChair(map);
  map.FindMutable(first)->mutable_info().sightings.SetTrack("robot", 1);
  map.FindMutable(second)->mutable_info().sightings.SetTrack("robot", 2);
  const SubmapId from = GetParam() ? first : second, into = GetParam() ? second : first;
  const auto before = map.Publish(1);
  MergeForGood(from, into, map);
  const auto after = map.Publish(2);
  const auto delta = Difference(*before, *after);
  const auto see = [&map](SubmapId id, std::int64_t frame) {
    map.FindMutable(id)->mutable_info().sightings.OnSeen("robot", frame);
  };
  see(into, 5);

  ASSERT_TRUE(ApplyDelta(delta, DeltaSide::kBefore, map).ok());
  for (const SubmapId id : {first, second}) {
    const Sightings& sightings = map.Find(id)->info().sightings;
    EXPECT_EQ(sightings.IsTrackedAs("robot", 1), id == first);
    EXPECT_EQ(sightings.IsTrackedAs("robot", 2), id == second);
  }
  EXPECT_TRUE(map.Find(into)->info().sightings.IsInSightOf("robot")) << "what frames have seen stays";
  EXPECT_FALSE(map.info().merged.Into(from));
  EXPECT_NE(map.info().pairs.Of(into, from).verdict, PairVerdict::kMustBeOne);

  see(into, 6);
  ASSERT_TRUE(ApplyDelta(delta, DeltaSide::kAfter, map).ok());
  for (const std::uint32_t track_id : {1u, 2u}) {
    EXPECT_TRUE(map.Find(into)->info().sightings.IsTrackedAs("robot", track_id)) << track_id;
  }
  EXPECT_EQ(map.info().merged.Into(from), into);
  EXPECT_EQ(map.info().pairs.Of(first, second).verdict, PairVerdict::kMustBeOne);
}

INSTANTIATE_TEST_SUITE_P(Into, UndoneMerge, ::testing::Bool(),
                         [](const auto& later) { return later.param ? "TheLater" : "TheOlder"; });

TEST(ApplyDelta, AMergeThatIsUndoneGivesTheIdBackThatTheLaterOneGotFromTheOlder) {
  Map map(MapOfClasses());
  const SubmapId from = AddChair(map), into = AddChair(map);
  map.FindMutable(from)->mutable_info().track_id = 7;
  map.FindMutable(from)->mutable_info().sightings.SetTrack("robot", 7);
  const auto before = map.Publish(1);
  MergeSubmaps(from, into, map);
  const auto after = map.Publish(2);
  ASSERT_TRUE(ApplyDelta(Difference(*before, *after), DeltaSide::kBefore, map).ok());
  EXPECT_EQ(map.Find(from)->info().sightings.TrackOf("robot"), 7u);
  EXPECT_EQ(map.Find(from)->info().track_id, 7u);
  EXPECT_FALSE(map.Find(into)->info().sightings.HasTrack());
}

TEST(ApplyDelta, WhatIsAPartOfAnotherByNowDoesNotComeBackBesideIt) {
  Map map(MapOfClasses());
  const SubmapId id = AddChair(map), whole = AddChair(map);
  const auto before = map.Publish(1);
  map.Remove(id);
  const auto after = map.Publish(2);
  map.PutBack(before->Find(id)->info());
  MergeSubmaps(id, whole, map);
  const Status status = ApplyDelta(Difference(*before, *after), DeltaSide::kBefore, map);
  EXPECT_EQ(status.reason(), Reason("UNDO_CONFLICT")) << status.ToString();
  EXPECT_EQ(map.Find(id), nullptr);
}

TEST(ApplyDelta, ADeletionOfTheWholeThatIsUndoneKnowsThatSomebodyHasMergedIt) {
  Map map(MapOfClasses());
  const SubmapId whole = AddChair(map), part = AddChair(map);
  MergeForGood(part, whole, map);
  const auto before = map.Publish(1);
  map.Remove(whole);
  const auto after = map.Publish(2);
  ASSERT_TRUE(ApplyDelta(Difference(*before, *after), DeltaSide::kBefore, map).ok());
  EXPECT_EQ(map.info().pairs.Of(whole, part).verdict, PairVerdict::kMustBeOne);
}

TEST(ApplyDelta, TheSphereHoldsWhatFramesHaveAddedWhereItWasLarger) {
  Map map(MapOfClasses());
  const SubmapId id = AddChair(map);
  const auto observe = [&](std::int32_t block_x) {
    Submap& submap = *map.FindMutable(id);
    submap.MutableTsdf({block_x, 0, 0}).weight[0] = 1;
    submap.UpdateBoundingSphere();
  };
  for (const std::int32_t block_x : {0, 1, 20}) observe(block_x);
  const auto before = map.Publish(1);
  map.FindMutable(id)->EraseBlock({20, 0, 0});
  map.FindMutable(id)->UpdateBoundingSphere();
  const auto after = map.Publish(2);
  const auto delta = Difference(*before, *after);
  delta.submaps.at(0).tiles.at(0).before->stored(BlockLayer::kTsdf).Set(1, 7);  // as a store does
  ASSERT_TRUE(ApplyDelta(delta, DeltaSide::kBefore, map).ok());
  ASSERT_EQ(map.Find(id)->bounding_sphere().radius_m, before->Find(id)->bounding_sphere().radius_m) << "to the bit";
  observe(9);
  ASSERT_TRUE(ApplyDelta(delta, DeltaSide::kAfter, map).ok());
  ASSERT_EQ(map.Find(id)->blocks().size(), 3u);
  const BoundingSphere& sphere = map.Find(id)->bounding_sphere();
  const double end_m = 10 * kBlockSide * map.info().config.voxel_size_m;
  EXPECT_GE(sphere.center_m.x() + sphere.radius_m, end_m);
}

TEST(ApplyDelta, ABackgroundDoesNotComeBackBesideTheOneThatIsThereNow) {
  Map map(MapOfClasses());
  const auto add_stuff = [&map] { return map.Create(testing::InfoOn(map, Panoptic::kStuff, ClassId(4))).id(); };
  const SubmapId floor = add_stuff();
  const auto before = map.Publish(1);
  map.Remove(floor);
  const auto after = map.Publish(2);
  const SubmapId anew = add_stuff();
  const auto delta = Difference(*before, *after);
  const Status status = ApplyDelta(delta, DeltaSide::kBefore, map);
  EXPECT_EQ(status.reason().name(), "UNDO_CONFLICT");
  map.Remove(anew);
  EXPECT_TRUE(ApplyDelta(delta, DeltaSide::kBefore, map).ok());
}

TEST(ApplyDelta, ARelabelledBackgroundDoesNotComeBackBesideWhatWasSeenInItsPlace) {
  for (const bool is_relabelled_first : {true, false}) {
    Map map(MapOfClasses());
    const auto add_stuff = [&map](bool is_relabelled) {
      SubmapInfo info = testing::InfoOn(map, Panoptic::kStuff, ClassId(is_relabelled ? 3 : 4));
      info.class_is_fixed = is_relabelled;
      info.class_counts = {{ClassId(4), 9}};
      return map.Create(std::move(info)).id();
    };
    const SubmapId floor = add_stuff(is_relabelled_first);
    const auto before = map.Publish(1);
    map.Remove(floor);
    const auto after = map.Publish(2);
    const SubmapId anew = add_stuff(!is_relabelled_first);
    const auto delta = Difference(*before, *after);
    const Status status = ApplyDelta(delta, DeltaSide::kBefore, map);
    EXPECT_EQ(status.reason().name(), "UNDO_CONFLICT") << is_relabelled_first;
    map.Remove(anew);
    EXPECT_TRUE(ApplyDelta(delta, DeltaSide::kBefore, map).ok());
  }
}

TEST(DiffRows, OfLongListsCostsWhatDiffers) {
  Map map(MapOfClasses());
  std::vector<MergedId> merged;
  for (std::uint32_t i = 0; i < 50'000; ++i) merged.push_back({SubmapId(i + 10), SubmapId(1)});
  map.mutable_info().merged = *MergedIds::Create(merged);
  const auto before = map.Publish(1);
  merged.push_back({SubmapId(70'000), SubmapId(1)});
  map.mutable_info().merged = *MergedIds::Create(merged);
  const auto after = map.Publish(2);
  const StateDelta delta = DiffRows(*before, *after);  // in milliseconds: a second for each pair compared with each
  EXPECT_TRUE(delta.merged.before.empty());
  ASSERT_EQ(delta.merged.after.size(), 1u);
  EXPECT_EQ(delta.merged.after[0].merged, SubmapId(70'000));
}

}  // namespace
}  // namespace dhpmap
