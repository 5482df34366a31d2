// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/object_care.h"

#include <gtest/gtest.h>

#include "mapping/objects/pair_evidence.h"
#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

constexpr ClassId kSeat{1}, kDesk{2};

/// A row of things along x, each a sheet of one block, side by side.
class ObjectCareTest : public ::testing::Test {
 protected:
  SubmapId AddSheet(int block_x, ClassId class_id = kSeat, int num_voxels = kBlockVoxels) {
    Submap& submap = map_.Create(testing::SettledThingOn(map_, class_id));
    TsdfBlock& tsdf = submap.MutableTsdf({block_x, 0, 0});
    for (int i = 0; i < num_voxels; ++i) tsdf.weight[static_cast<std::size_t>(i)] = 1;
    submap.UpdateBoundingSphere();
    return submap.id();
  }

  /// A frame in which segment s has hits[s][c] points on thing c; rows[s] is its row.
  void See(const std::vector<SubmapId>& things, const std::vector<int>& rows,
           const std::vector<std::vector<std::int64_t>>& hits) {
    std::vector<SegmentBundles> segments(rows.size());
    for (std::size_t s = 0; s < rows.size(); ++s) segments[s].row = rows[s];
    OverlapTable overlaps{.candidates = things, .hits = hits, .candidate_hits = {}};
    overlaps.candidate_hits.assign(things.size(), 0);
    for (const auto& row : hits) {
      for (std::size_t c = 0; c < row.size(); ++c) overlaps.candidate_hits[c] += row[c];
    }
    NotePairs(segments, overlaps, map_);
  }
  void SeeAsOne(SubmapId a, SubmapId b, int num_frames) {
    for (; num_frames > 0; --num_frames) See({a, b}, {0, 0}, {{500, 0}, {0, 300}});  // two parts of one segment
  }
  void SeeApart(SubmapId a, SubmapId b, int num_frames) {
    for (; num_frames > 0; --num_frames) See({a, b}, {0, 1}, {{500, 0}, {0, 300}});
  }

  Map map_{testing::NamedMap("m", 3, 1)};
};

TEST_F(ObjectCareTest, TwoThatTenFramesShowAsOneBecomeTheOlder) {
  const SubmapId a = AddSheet(0), b = AddSheet(1);
  SeeAsOne(a, b, 9);
  EXPECT_EQ(MergePairs(map_, 100), 0);
  SeeAsOne(a, b, 1);
  EXPECT_EQ(MergePairs(map_, 100), 1);
  EXPECT_EQ(map_.info().merged.Into(b), a);
  EXPECT_EQ(map_.Find(a)->blocks().size(), 2u);
  EXPECT_EQ(MergePairs(map_, 100), 0);
}

TEST_F(ObjectCareTest, WhatIsSeenApartHalfTheTimeStaysTwo) {
  const SubmapId a = AddSheet(0), b = AddSheet(1);
  for (int i = 0; i < 500; ++i) {
    SeeAsOne(a, b, 1 + i % 3);
    SeeApart(a, b, 1 + i % 3);
    EXPECT_EQ(MergePairs(map_, 100), 0);
  }
}

TEST_F(ObjectCareTest, NetworkThatCutsAnObjectInATenthOfTheFramesDoesNotKeepItTwo) {
  const SubmapId a = AddSheet(0), b = AddSheet(1);
  SeeApart(a, b, 3);
  for (int i = 0; i < 4; ++i) SeeAsOne(a, b, 9), SeeApart(a, b, 1);
  SeeAsOne(a, b, 9);
  EXPECT_EQ(MergePairs(map_, 100), 1);
}

TEST_F(ObjectCareTest, EvidenceIsBoundedSoThatAChangeIsNoticed) {
  const SubmapId a = AddSheet(0), b = AddSheet(1);
  SeeApart(a, b, 1000);
  EXPECT_EQ(map_.info().pairs.Of(a, b).evidence, kLeastEvidence);
  SeeAsOne(a, b, 30);
  EXPECT_EQ(MergePairs(map_, 100), 1);
}

TEST_F(ObjectCareTest, FramesThatDoNotShowBothSayNothing) {
  const SubmapId a = AddSheet(0), b = AddSheet(1), desk = AddSheet(1, kDesk), far = AddSheet(50);
  See({a, b}, {0, 1}, {{500, 0}, {0, 40}});      // too little of b
  See({a, b}, {0, 1}, {{500, 200}, {0, 200}});   // half of b in each
  See({a, b}, {0, -1}, {{500, 0}, {0, 300}});    // b was missed
  See({a, desk}, {0, 0}, {{500, 0}, {0, 300}});  // of another class
  See({a, far}, {0, 0}, {{500, 0}, {0, 300}});   // far away
  EXPECT_TRUE(map_.info().pairs.pairs().empty());
}

TEST_F(ObjectCareTest, OnlyWhatTouchesIsMerged) {
  const SubmapId a = AddSheet(0), b = AddSheet(2);
  map_.mutable_info().pairs.AddEvidence(a, b, kIsOne, kLeastEvidence, kIsOne);
  EXPECT_EQ(MergePairs(map_, 100), 0);
}

TEST_F(ObjectCareTest, WhatSomebodyHasEditedStays) {
  const auto edits = {+[](SubmapInfo& info) { info.is_placed = true; },
                      +[](SubmapInfo& info) { info.class_is_fixed = true; },
                      +[](SubmapInfo& info) { info.display_name = "throne"; }};
  for (const auto edit : edits) {
    const SubmapId a = AddSheet(0), b = AddSheet(1), remnant = AddSheet(5, kSeat, 1);
    edit(map_.FindMutable(b)->mutable_info());
    edit(map_.FindMutable(remnant)->mutable_info());
    SeeAsOne(a, b, 50);
    EXPECT_EQ(MergePairs(map_, 100), 0);
    EXPECT_EQ(DissolveRemnants(map_), 0);
    for (const SubmapId id : {a, b, remnant}) map_.Remove(id);
  }
}

TEST_F(ObjectCareTest, VerdictsHoldWhateverFramesSay) {
  const SubmapId a = AddSheet(0), b = AddSheet(1), c = AddSheet(20), d = AddSheet(40, kDesk);
  map_.mutable_info().pairs.SetVerdict(a, b, PairVerdict::kMustBeTwo);
  map_.mutable_info().pairs.SetVerdict(c, d, PairVerdict::kMustBeOne);
  SeeAsOne(a, b, 50);
  EXPECT_EQ(MergePairs(map_, 100), 1);
  EXPECT_NE(map_.Find(b), nullptr);
  EXPECT_EQ(map_.info().merged.Into(d), c);
  EXPECT_EQ(map_.info().pairs.Of(c, d).verdict, PairVerdict::kMustBeOne) << "as somebody has said";
  EXPECT_EQ(MergePairs(map_, 100), 0) << "once";
}

TEST_F(ObjectCareTest, MoreThanAFrameMayWaitForIsLeftForTheNextTime) {
  const SubmapId a = AddSheet(0), b = AddSheet(1), c = AddSheet(20), d = AddSheet(21);
  SeeAsOne(a, b, 10);
  SeeAsOne(c, d, 10);
  EXPECT_EQ(MergePairs(map_, 1), 1);
  EXPECT_EQ(MergePairs(map_, 1), 1);
  EXPECT_EQ(map_.submaps().size(), 3u);
}

TEST_F(ObjectCareTest, SettledThingOfWhichNothingIsLeftToBeSeenDissolves) {
  const SubmapId gone = AddSheet(0, kSeat, 2), there = AddSheet(1, kSeat, 3), active = AddSheet(2, kSeat, 0),
                 absent = AddSheet(3, kSeat, 0);
  map_.FindMutable(active)->mutable_info().activity = Activity::kActive;
  map_.FindMutable(absent)->mutable_info().presence = Presence::kAbsent;
  EXPECT_EQ(DissolveRemnants(map_), 1);
  EXPECT_EQ(map_.Find(gone), nullptr);
  for (const SubmapId id : {there, active, absent}) EXPECT_NE(map_.Find(id), nullptr);
  EXPECT_EQ(map_.Find(kUnknownSubmap)->blocks().Find({0, 0, 0})->tsdf->NumObservedVoxels(), 2) << "its geometry stays";
}

/// What frames took for a thing and who holds it now: the thing itself little surface, another object the rest.
class RemnantTest : public ObjectCareTest {
 protected:
  static constexpr int kOwnVoxels = 10;

  /// Each voxel of the thing was seen as it `own` times; the object around it has `others` voxels that were seen so
  /// once.
  SubmapId AddSeen(int num_voxels, std::uint32_t own, int others) {
    const SubmapId thing = AddSheet(0, kSeat, num_voxels), around = AddSheet(1, kDesk);
    LabelBlock& labels = map_.FindMutable(thing)->MutableLabels({0, 0, 0});
    for (int i = 0; i < num_voxels; ++i) labels.Add(i, {{{kSeat.value, own}}, {{kOwnInstance, own}}});
    LabelBlock& beside = map_.FindMutable(around)->MutableLabels({1, 0, 0});
    for (int i = 0; i < others; ++i) {
      beside.Add(i, {{{kDesk.value, 5}, {kSeat.value, 1}}, {{kOwnInstance, 5}, {SeenInstance(thing), 1}}});
    }
    return thing;
  }
};

TEST_F(RemnantTest, LittleSurfaceAroundWhichOthersHoldMostDissolves) {
  const SubmapId thing = AddSeen(kOwnVoxels, 2, 4 * 2 * kOwnVoxels + 1);
  EXPECT_EQ(DissolveRemnants(map_), 1);
  EXPECT_EQ(map_.Find(thing), nullptr);
  EXPECT_EQ(map_.Find(kUnknownSubmap)->blocks().Find({0, 0, 0})->tsdf->NumObservedVoxels(), kOwnVoxels);
}

TEST_F(RemnantTest, SmallThingOfWhichOthersHoldLessStays) {
  const SubmapId thing = AddSeen(kOwnVoxels, 2, 4 * 2 * kOwnVoxels);
  EXPECT_EQ(DissolveRemnants(map_), 0);
  EXPECT_NE(map_.Find(thing), nullptr);
}

TEST_F(RemnantTest, ThingWithMuchSurfaceStaysWhateverOthersHold) {
  const SubmapId thing = AddSeen(3 * kOwnVoxels, 1, kBlockVoxels);
  EXPECT_EQ(DissolveRemnants(map_), 0);
  EXPECT_NE(map_.Find(thing), nullptr);
}

TEST_F(RemnantTest, WhatACloneHoldsSaysNothing) {
  const SubmapId thing = AddSeen(kOwnVoxels, 2, kBlockVoxels);
  map_.FindMutable(SubmapId(thing.value + 1))->mutable_info().is_placed = true;
  EXPECT_EQ(DissolveRemnants(map_), 0);
  EXPECT_NE(map_.Find(thing), nullptr);
}

}  // namespace
}  // namespace dhpmap
