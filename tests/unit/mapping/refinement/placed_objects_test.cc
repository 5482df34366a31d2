// SPDX-License-Identifier: BSD-3-Clause
// What somebody has moved or cloned stands outside of the map's grid, even where it lies on it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "mapping/evidence/stray_voxels.h"
#include "mapping/refinement/adopt_refinement.h"
#include "mapping/refinement/pending_cubes.h"
#include "mapping/refinement/refine_map.h"
#include "mapping/refinement/refinement_round.h"
#include "mapping/refinement/region_part.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

using testing::AddSubmap;
using testing::AllIds;
using testing::MapsAreEqual;
using testing::Put;
using testing::SubmapsAreEqual;
using testing::Sum;

Map SettledRandomMap(unsigned seed) {
  Map map = testing::RandomMap(seed);
  for (const SubmapId id : AllIds(map)) map.FindMutable(id)->mutable_info().activity = Activity::kInactive;
  return map;
}

/// As somebody clones it where it is.
SubmapId CloneInPlace(SubmapId id, Map& map) {
  Submap& clone = *map.Clone(id);
  clone.mutable_info().is_placed = true;
  return clone.id();
}

/// A random map, and the same with a clone of each object in its place. Voxels of the originals name some of the
/// clones' ids, too.
class ClonesInPlace : public ::testing::TestWithParam<unsigned> {
 protected:
  ClonesInPlace() {
    for (const SubmapId id : AllIds(alone_)) {
      if (id != kUnknownSubmap) clones_.push_back(CloneInPlace(id, map_));
    }
    before_ = map_.Freeze();
  }

  /// Each clone is as it was, each original as it would be without any clone.
  void ExpectRefinedAsIfAlone() {
    EXPECT_EQ(map_.submaps().size(), alone_.submaps().size() + clones_.size());
    for (const SubmapId id : clones_) {
      ASSERT_NE(map_.Find(id), nullptr);
      EXPECT_TRUE(SubmapsAreEqual(*before_->Find(id), *map_.Find(id))) << "clone " << id.value;
    }
    for (const SubmapId id : AllIds(alone_)) {
      ASSERT_NE(map_.Find(id), nullptr);
      EXPECT_TRUE(SubmapsAreEqual(*alone_.Find(id), *map_.Find(id))) << "original " << id.value;
    }
  }

  ThreadPool pool_{2};
  Map alone_ = SettledRandomMap(GetParam());
  Map map_ = alone_.Fork();
  std::vector<SubmapId> clones_;
  std::shared_ptr<const MapSnapshot> before_;
};

TEST_P(ClonesInPlace, KeepAllTheyHaveAndLeaveTheirOriginalsAllTheyHave) {
  const auto sum = Sum(map_);
  const RefinementReport report = RefineMap(map_, pool_);
  EXPECT_GT(RefineMap(alone_, pool_).management.num_moved_voxels, 0);
  EXPECT_EQ(report.management.num_skipped_submaps, static_cast<int>(clones_.size()));
  ExpectRefinedAsIfAlone();
  EXPECT_EQ(Sum(map_), sum);
}

/// As MapBuilder::Finish does it.
void RefineAllThatIsPending(Map& map, ThreadPool& pool) {
  PendingCubes pending;
  pending.Note(*map.Freeze(), RimOfLabels(map.info().config));
  const std::vector<CubeIndex> cubes(pending.cubes().begin(), pending.cubes().end());
  const RefinementRegion all(cubes);
  RefineMap(map, pool, &all);
}

TEST_P(ClonesInPlace, KeepAllTheyHaveAtFinishMapping) {
  const auto sum = Sum(map_);
  for (Map* map : {&map_, &alone_}) RefineAllThatIsPending(*map, pool_);
  ExpectRefinedAsIfAlone();
  EXPECT_EQ(Sum(map_), sum);
  for (Map* map : {&map_, &alone_}) EXPECT_GT(DropVoxelLabels(*map), 0);
  ExpectRefinedAsIfAlone();
}

TEST_P(ClonesInPlace, KeepAllTheyHaveThroughARoundOnTheSide) {
  const auto sum = Sum(map_);
  RefineMap(alone_, pool_);
  RefinementRound round;
  do {
    const auto state = map_.Freeze();
    round.Begin(*state, 5, 1);
    const RegionPart part = round.NextPart();
    Map side = GoOnFrom(*state, part);
    round.RefineNext(side, pool_);
    const auto refined = side.Freeze();
    EXPECT_EQ(AdoptRefinement(OutcomeOf(round.pending().marks(), *refined, part), map_), 0);
    round.End(*refined, part);
  } while (!round.IsFinished());
  ExpectRefinedAsIfAlone();
  EXPECT_EQ(Sum(map_), sum);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ClonesInPlace, ::testing::Range(0u, 6u));

constexpr double kBand_vox = 3.0;
constexpr SubmapId kFloorId(1), kBallId(2);

/// A ball that lies on a floor: the bands around their surfaces share the voxels where they touch. Both are settled.
Map BallOnFloor() {
  constexpr double kRadius_vox = 8;
  Map map(testing::RandomMapInfo());
  const auto voxel_m = static_cast<float>(map.info().config.voxel_size_m);
  Submap &floor = AddSubmap(map, Panoptic::kStuff), &ball = AddSubmap(map);
  floor.mutable_info().class_id = ClassId(3);
  ball.mutable_info().activity = Activity::kInactive;
  for (int x = -12; x <= 12; ++x) {
    for (int y = -12; y <= 12; ++y) {
      for (int z = -4; z <= 20; ++z) {
        const double to_floor_vox = z, to_ball_vox = std::hypot(x, y, z - kRadius_vox) - kRadius_vox;
        if (std::abs(to_floor_vox) < kBand_vox) {
          Put(floor, {x, y, z}, voxel_m * static_cast<float>(to_floor_vox), 2.0f, {{{3, 4}}, {{kOwnInstance, 4}}});
        }
        if (std::abs(to_ball_vox) < kBand_vox) {
          Put(ball, {x, y, z}, voxel_m * static_cast<float>(to_ball_vox), 1.0f, {{{1, 5}}, {{kOwnInstance, 5}}});
        }
      }
    }
  }
  for (const SubmapId id : {kFloorId, kBallId}) map.FindMutable(id)->UpdateBoundingSphere();
  return map;
}

TEST(PlacedObjects, ACloneOnTheFloorHasNoSayInWhatTheFloorAndItsOriginalHold) {
  Map map = BallOnFloor(), alone = BallOnFloor();
  const SubmapId clone = CloneInPlace(kBallId, map);
  const auto before = map.Freeze();
  const auto sum = Sum(map);
  ThreadPool pool(2);
  EXPECT_GT(RefineMap(alone, pool).management.num_shared_voxels, 0);
  RefineMap(map, pool);
  ASSERT_NE(map.Find(clone), nullptr);
  EXPECT_TRUE(SubmapsAreEqual(*before->Find(clone), *map.Find(clone)));
  for (const SubmapId id : {kFloorId, kBallId}) EXPECT_TRUE(SubmapsAreEqual(*alone.Find(id), *map.Find(id)));
  EXPECT_EQ(Sum(map), sum);
}

TEST(PlacedObjects, WhatWasMovedBackToItsPlaceSharesItWithWhatIsThereNow) {
  Map map = BallOnFloor();
  SubmapInfo& ball = map.FindMutable(kBallId)->mutable_info();
  ball.T_map_submap = Eigen::Translation3d(0.1, 0, 0) * Eigen::Translation3d(-0.1, 0, 0);
  ball.is_placed = true;
  const auto before = map.Freeze();
  ThreadPool pool(1);
  RefineMap(map, pool);
  EXPECT_TRUE(MapsAreEqual(*before, *map.Freeze()));
}

TEST(PlacedObjects, OneThatIsPlacedNoLongerIsRefinedAgain) {
  Map map = BallOnFloor(), expected = BallOnFloor();
  map.FindMutable(kBallId)->mutable_info().is_placed = true;
  ThreadPool pool(1);
  PendingCubes pending;
  pending.Note(*map.Freeze(), 1);
  const std::vector<CubeIndex> cubes(pending.cubes().begin(), pending.cubes().end());
  pending.Remove(cubes);
  RefineMap(map, pool);
  pending.NoteRefined(*map.Freeze());

  map.FindMutable(kBallId)->mutable_info().is_placed = false;  // undone
  pending.Note(*map.Freeze(), 1);
  EXPECT_TRUE(pending.cubes().contains(CubeOf(BlockIndex{0, 0, 1})));
  RefineMap(map, pool);
  RefineMap(expected, pool);
  EXPECT_TRUE(MapsAreEqual(*expected.Freeze(), *map.Freeze()));
}

TEST(PlacedObjects, MakeNoCubePendingWhenTheyAreWritten) {
  Map map = BallOnFloor();
  const SubmapId clone = CloneInPlace(kBallId, map);
  PendingCubes pending;
  pending.Note(*map.Freeze(), 1);
  const std::vector<CubeIndex> cubes(pending.cubes().begin(), pending.cubes().end());
  pending.Remove(cubes);
  Put(*map.FindMutable(clone), {300, 5, 5}, 0, 1, {{{1, 1}}, {{kOwnInstance, 1}}});
  pending.Note(*map.Freeze(), 1);
  EXPECT_TRUE(pending.cubes().empty());
}

TEST(PlacedObjects, WrittenWhileTheMapIsRefinedTheyHoldNothingUp) {
  Map map = BallOnFloor();
  const SubmapId clone = CloneInPlace(kBallId, map);
  const auto before = map.Freeze();
  ThreadPool pool(1);
  Map side(before);
  RefineMap(side, pool);
  const auto refined = side.Freeze();
  for (const BlockEntry& entry : before->Find(clone)->blocks().entries()) {  // fused into all over
    Put(*map.FindMutable(clone), VoxelIn(entry.index, 0), 0.01f, 1.0f, {{{1, 1}}, {{kOwnInstance, 1}}});
  }
  const auto now = map.Freeze();
  EXPECT_EQ(AdoptRefinement(OutcomeOf(std::make_shared<const StateMarks>(*before), *refined), map), 0);
  EXPECT_TRUE(SubmapsAreEqual(*now->Find(clone), *map.Find(clone)));
  for (const SubmapId id : {kFloorId, kBallId}) EXPECT_TRUE(SubmapsAreEqual(*refined->Find(id), *map.Find(id)));
}

TEST(PlacedObjects, GiveNoStrayVoxelAndAreGivenNone) {
  constexpr VoxelIndex kStray{1, 1, 40}, kOnTheFloor{-11, -11, 2};
  for (const SubmapId placed : {kFloorId, kBallId}) {
    Map map = BallOnFloor();
    for (int z : {39, 41}) Put(*map.FindMutable(kFloorId), {1, 1, z}, 0.01f, 1.0f, {{{3, 4}}, {{kOwnInstance, 4}}});
    for (const VoxelIndex v : {kStray, kOnTheFloor}) {
      Put(*map.FindMutable(kBallId), v, 0.01f, 1.0f, {{{1, 5}}, {{kOwnInstance, 5}}});
    }
    ThreadPool pool(1);
    Map as_ever = map.Fork();
    EXPECT_EQ(AbsorbStrayVoxels(AllIds(as_ever), as_ever, pool), 2);
    map.FindMutable(placed)->mutable_info().is_placed = true;
    const auto before = map.Freeze();
    EXPECT_EQ(AbsorbStrayVoxels(AllIds(map), map, pool), 0);
    EXPECT_TRUE(MapsAreEqual(*before, *map.Freeze()));
  }
}

TEST(PlacedObjects, LabelsThatWereDroppedOfThemAreNotMadeUpAgain) {
  for (const bool is_in_place : {true, false}) {
    Map map = BallOnFloor();
    const SubmapId clone = CloneInPlace(kBallId, map);
    if (!is_in_place) map.FindMutable(clone)->mutable_info().T_map_submap.translation().x() = 1.0;
    map.FindMutable(clone)->DropLabels();
    const auto before = map.Freeze();
    ThreadPool pool(1);
    RefineMap(map, pool);
    ASSERT_NE(map.Find(clone), nullptr);
    EXPECT_TRUE(SubmapsAreEqual(*before->Find(clone), *map.Find(clone)));
  }
}

}  // namespace
}  // namespace dhpmap
