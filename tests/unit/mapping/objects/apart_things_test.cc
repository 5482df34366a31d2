// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/apart_things.h"

#include <gtest/gtest.h>

#include <functional>

#include "mapping/objects/merge_submaps.h"
#include "mapping/objects/object_care.h"
#include "mapping/objects/pair_evidence.h"
#include "tests/support/map_equality.h"
#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

constexpr int kCell_vox = 10;
constexpr std::int64_t kLeast = 20;

/// A thing of sheets of voxels in the plane z = 0, each 6 x 6 voxels from (x, 0) on.
class ApartThings : public ::testing::Test {
 protected:
  SubmapId AddThing(const std::vector<int>& sheets_at_x, int side_vox = 6) {
    SubmapInfo info = testing::SettledThingOn(map_, ClassId(1));
    info.is_confirmed = true;
    const SubmapId id = map_.Create(std::move(info)).id();
    for (const int x : sheets_at_x) AddSheetTo(id, x, side_vox);
    return id;
  }

  void AddSheetTo(SubmapId id, int x0, int side_vox) {
    Submap& submap = *map_.FindMutable(id);
    for (int x = x0; x < x0 + side_vox; ++x) {
      for (int y = 0; y < side_vox; ++y) {
        const VoxelIndex v{x, y, 0};
        submap.MutableTsdf(BlockOf(v)).weight[static_cast<std::size_t>(LinearIndex(v))] = 1;
        submap.MutableLabels(BlockOf(v)).Set(LinearIndex(v), {{{1, 3}}, {{kOwnInstance, 3}}});
        submap.AddClassObservations(ClassId(1), 3);
      }
    }
    submap.UpdateBoundingSphere();
  }

  int Split() { return SplitApartThings(kCell_vox, kLeast, map_); }
  int NumVoxels(SubmapId id) const {
    int number = 0;
    for (const BlockEntry& entry : map_.Find(id)->blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) number += entry.tsdf != nullptr && entry.tsdf->IsObserved(i);
    }
    return number;
  }

  Map map_{testing::NamedMap("m", 2, 1)};
};

TEST_F(ApartThings, WhatLiesApartBecomesTwoOfWhichTheLargerKeepsTheId) {
  const SubmapId id = AddThing({0});
  AddSheetTo(id, 40, 8);
  EXPECT_EQ(Split(), 1);
  const SubmapId made = map_.submaps().back()->id();
  ASSERT_NE(made, id);
  EXPECT_EQ(NumVoxels(id), 64);
  EXPECT_EQ(NumVoxels(made), 36);
  const SubmapInfo& info = map_.Find(made)->info();
  EXPECT_EQ(info.class_id, ClassId(1));
  ASSERT_EQ(info.class_counts.size(), 1u);
  EXPECT_EQ(info.class_counts[0].count, 36u * 3);
  EXPECT_EQ(map_.Find(id)->info().class_counts[0].count, 64u * 3);
  EXPECT_FALSE(IsEdited(info)) << "nobody has";
  EXPECT_EQ(Split(), 0) << "again changes nothing";
}

TEST_F(ApartThings, WhatASegmentMayHaveShownAsOneStaysOne) {
  // Cells of 10 voxels: sheets in neighbouring ones are together, one with a cell between is not.
  const SubmapId near = AddThing({2, 13});
  EXPECT_EQ(Split(), 0);
  AddSheetTo(near, 32, 6);
  EXPECT_EQ(Split(), 1);
}

TEST_F(ApartThings, ScrapsStayWithTheLargest) {
  const SubmapId id = AddThing({0});
  AddSheetTo(id, 40, 4);
  AddSheetTo(id, -60, 3);
  EXPECT_EQ(Split(), 0);
  AddSheetTo(id, 80, 5);
  EXPECT_EQ(Split(), 1);
  EXPECT_EQ(NumVoxels(id), 36 + 16 + 9);
}

TEST_F(ApartThings, VoxelsBeforeAndBehindTheSurfaceAreNoReasonToSplit) {
  const SubmapId id = AddThing({0, 40});
  for (std::int32_t block = 5; block < 7; ++block) {
    map_.FindMutable(id)
        ->MutableTsdf({block, 0, 0})
        .distance_m.fill(static_cast<float>(0.6 * map_.info().config.voxel_size_m));
  }
  EXPECT_EQ(Split(), 0);
}

TEST_F(ApartThings, EveryPartOfManyIsAThing) {
  const SubmapId id = AddThing({0, 40, 80, -40, -80});
  EXPECT_EQ(Split(), 4);
  EXPECT_EQ(NumVoxels(id), 36);
  std::vector<int> many;
  for (int i = 0; i < 20; ++i) many.push_back(200 + 40 * i);
  AddThing(many);
  EXPECT_EQ(Split(), kMostApartParts - 1) << "it has a bound";
}

TEST_F(ApartThings, FramesMayMakeOneOfThemAgainButNotAtOnce) {
  const SubmapId id = AddThing({0, 40});
  ASSERT_EQ(Split(), 1);
  const SubmapId made = map_.submaps().back()->id();
  const ObjectPair pair = map_.info().pairs.Of(id, made);
  EXPECT_EQ(pair.verdict, PairVerdict::kOpen);
  EXPECT_EQ(pair.evidence, kLeastEvidence);
  AddSheetTo(id, 34, 6);  // what was between is seen: they touch
  EXPECT_EQ(MergePairs(map_, 100), 0);
  map_.mutable_info().pairs.AddEvidence(id, made, kIsOne - kLeastEvidence, kLeastEvidence, ObjectPairs::kMostEvidence);
  EXPECT_EQ(MergePairs(map_, 100), 1);
}

TEST_F(ApartThings, WhomTheWholeMustNotBeMergedWithItsPartsMustNot) {
  const SubmapId id = AddThing({0, 40}), other = AddThing({6});
  map_.mutable_info().pairs.SetVerdict(id, other, PairVerdict::kMustBeTwo);
  ASSERT_EQ(Split(), 1);
  const SubmapId made = map_.submaps().back()->id();
  EXPECT_EQ(map_.info().pairs.Of(made, other).verdict, PairVerdict::kMustBeTwo);
  EXPECT_EQ(map_.info().pairs.Of(id, other).verdict, PairVerdict::kMustBeTwo);
}

TEST_F(ApartThings, WhatIsNotForFramesToDecideStays) {
  const std::vector<std::function<void(SubmapInfo&)>> reasons = {
      [](SubmapInfo& info) { info.activity = Activity::kActive; },
      [](SubmapInfo& info) { info.is_confirmed = false; },
      [](SubmapInfo& info) { info.is_locked = true; },
      [](SubmapInfo& info) { info.display_name = "sofa"; },
      [](SubmapInfo& info) { info.class_is_fixed = true; },
      [](SubmapInfo& info) { info.edited_revision = 7; },
      [](SubmapInfo& info) { info.presence = Presence::kAbsent; },
      [](SubmapInfo& info) { info.panoptic = Panoptic::kStuff; },
      [](SubmapInfo& info) { info.sightings.SetTrack("robot", 4); },
      [](SubmapInfo& info) { info.T_map_submap.translation().x() = 0.5; },
  };
  const SubmapId id = AddThing({0, 40});
  const SubmapInfo before = map_.Find(id)->info();
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    reasons[i](map_.FindMutable(id)->mutable_info());
    EXPECT_EQ(Split(), 0) << i;
    map_.FindMutable(id)->mutable_info() = before;
  }
  EXPECT_EQ(Split(), 1);
}

TEST_F(ApartThings, WhatSomebodyHasMergedStaysOne) {
  const SubmapId id = AddThing({0, 40}), gone = AddThing({90});
  MergeForGood(gone, id, map_);
  ASSERT_EQ(map_.info().pairs.Of(id, gone).verdict, PairVerdict::kMustBeOne);
  EXPECT_EQ(Split(), 0);
}

TEST_F(ApartThings, NoCellsSwitchItOff) {
  AddThing({0, 40});
  const auto before = map_.Publish(1);
  EXPECT_EQ(SplitApartThings(0, kLeast, map_), 0);
  EXPECT_EQ(map_.Publish(2), before);
}

}  // namespace
}  // namespace dhpmap
