// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/region_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>

#include "mapping/refinement/adopt_refinement.h"
#include "mapping/refinement/pending_cubes.h"
#include "mapping/refinement/refine_map.h"
#include "mapping/refinement/refinement_round.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

using testing::AllIds;
using testing::Put;
using testing::RandomMap;

/// Random submaps around the corner of eight cubes, all settled.
Map Settled(unsigned seed) {
  Map map = RandomMap(seed);
  for (const SubmapId id : AllIds(map)) map.FindMutable(id)->mutable_info().activity = Activity::kInactive;
  return map;
}

class Regions : public ::testing::TestWithParam<unsigned> {
 protected:
  Map map_ = Settled(GetParam());
  ThreadPool pool_{2};
};

TEST_P(Regions, OneAfterTheOtherInAnyOrderMakeWhatAllAtOnceMake) {
  Map at_once = map_.Fork();
  RefineMap(at_once, pool_);
  PendingCubes pending;
  pending.Note(*map_.Freeze(), 1);
  std::vector<CubeIndex> cubes(pending.cubes().begin(), pending.cubes().end());
  ASSERT_GT(cubes.size(), 4u);
  std::mt19937 random(GetParam());
  std::shuffle(cubes.begin(), cubes.end(), random);
  std::int64_t num_changed = 0;
  for (const CubeIndex cube : cubes) {
    const RefinementRegion region(std::span(&cube, 1));
    num_changed += RefineRegion(map_, pool_, &region).crf.num_changed_instances;
  }
  RefineStrayVoxels(map_, pool_);
  EXPECT_GT(num_changed, 0);
  EXPECT_TRUE(testing::MapsAreEqual(*map_.Freeze(), *at_once.Freeze()));
}

TEST_P(Regions, NeedNoMoreOfAMapThanTheirPartOfIt) {
  Map at_once = map_.Fork();
  RefineMap(at_once, pool_);
  const int rim = RimOfLabels(map_.info().config);
  PendingCubes pending;
  pending.Note(*map_.Freeze(), rim);
  const std::vector<CubeIndex> cubes(pending.cubes().begin(), pending.cubes().end());
  std::size_t num_left_out = 0;
  for (const CubeIndex cube : cubes) {
    const RegionPart part(RefinementRegion(std::span(&cube, 1)), rim);
    const auto state = map_.Freeze();
    pending.Note(*state, rim);
    Map side = GoOnFrom(*state, part);
    const RefinementRegion region(std::span(&cube, 1));
    RefineRegion(side, pool_, &region);
    const auto refined = side.Freeze();
    EXPECT_EQ(AdoptRefinement(OutcomeOf(pending.marks(), *refined, part), map_), 0);
    pending.Remove(std::span(&cube, 1));
    pending.NoteRefined(*refined, part);
    for (const auto& submap : state->submaps()) {
      const Submap* cut = refined->Find(submap->id());
      num_left_out += cut == nullptr || cut->blocks().size() < submap->blocks().size();
    }
  }
  EXPECT_GT(num_left_out, 0u);
  pending.Note(*map_.Freeze(), rim);
  EXPECT_TRUE(pending.cubes().empty()) << "what a part made and was taken over is pending no longer";
  RefineStrayVoxels(map_, pool_);
  EXPECT_TRUE(testing::MapsAreEqual(*map_.Freeze(), *at_once.Freeze()));
}

TEST_P(Regions, OfARoundMakeWhatAllAtOnceMakeWhereNothingHappensMeanwhile) {
  Map at_once = map_.Fork();
  RefineMap(at_once, pool_);
  for (const int most_steps : {1, 2, 5}) {
    Map map = map_.Fork();
    RefinementRound round;
    int num_steps = 0;
    do {
      const auto state = map.Freeze();
      round.Begin(*state, most_steps, 1);
      const RegionPart part = round.NextPart();
      Map side = GoOnFrom(*state, part);
      round.RefineNext(side, pool_);
      const auto refined = side.Freeze();
      EXPECT_EQ(AdoptRefinement(OutcomeOf(round.pending().marks(), *refined, part), map), 0);
      round.End(*refined, part);
      ++num_steps;
    } while (!round.IsFinished());
    EXPECT_LE(num_steps, most_steps);
    EXPECT_TRUE(most_steps < 5 || num_steps > 2) << "stray voxels have a step of their own";
    EXPECT_TRUE(testing::MapsAreEqual(*map.Freeze(), *at_once.Freeze()));
    round.Begin(*map.Freeze(), most_steps, 1);
    EXPECT_TRUE(round.IsFinished()) << "what was refined and taken over is pending no longer";
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Regions, ::testing::Range(0u, 6u));

/// A settled thing of one voxel at each of `voxels`.
void AddThing(Map& map, std::initializer_list<VoxelIndex> voxels) {
  Submap& thing = testing::AddSubmap(map);
  thing.mutable_info().activity = Activity::kInactive;
  for (const VoxelIndex v : voxels) Put(thing, v, 0, 1, {{{1, 1}}, {{kOwnInstance, 1}}});
}

class PendingCubesTest : public ::testing::Test {
 protected:
  PendingCubesTest() { AddThing(map_, {{4, 4, 4}, {300, 4, 4}}); }

  std::set<CubeIndex> Pending() {
    pending_.Note(*map_.Freeze(), 1);
    return pending_.cubes();
  }
  void Refined() {
    const std::vector<CubeIndex> cubes(pending_.cubes().begin(), pending_.cubes().end());
    pending_.Remove(cubes);
  }

  Map map_{testing::RandomMapInfo()};
  PendingCubes pending_;
};

TEST_F(PendingCubesTest, AreAllAndThoseAroundAtFirst) {
  EXPECT_EQ(Pending().size(), 54u);
  EXPECT_TRUE(Pending().contains({0, 0, 0}));
  EXPECT_TRUE(Pending().contains({5, -1, 1}));
}

TEST_F(PendingCubesTest, AreNoneOnceAllWereRefined) {
  Pending();
  Refined();
  EXPECT_TRUE(Pending().empty());
}

TEST_F(PendingCubesTest, AreThoseWhereSomethingWasWritten) {
  Pending();
  Refined();
  Put(*map_.FindMutable(SubmapId(1)), {300, 5, 5}, 0, 1, {{{1, 1}}, {{kOwnInstance, 1}}});
  EXPECT_EQ(Pending().size(), 27u);
  EXPECT_TRUE(Pending().contains({4, 0, 0}));
  EXPECT_FALSE(Pending().contains({0, 0, 0}));
}

TEST_F(PendingCubesTest, AreThoseOfWhatIsGone) {
  Pending();
  Refined();
  map_.Remove(SubmapId(1));
  EXPECT_EQ(Pending().size(), 54u);
}

TEST_F(PendingCubesTest, AreThoseOfAThingThatSettlesThoughNothingOfItIsWritten) {
  map_.FindMutable(SubmapId(1))->mutable_info().activity = Activity::kActive;
  EXPECT_TRUE(Pending().empty());
  map_.FindMutable(SubmapId(1))->mutable_info().activity = Activity::kInactive;
  EXPECT_EQ(Pending().size(), 54u);
}

TEST_F(PendingCubesTest, AreCutIntoPartsThatHoldEachOnce) {
  for (std::int32_t x = 600; x < 1600; x += 64) AddThing(map_, {{x, 0, 0}, {x, 8, 0}, {x, 16, 0}});
  Pending();
  const auto state = map_.Freeze();
  for (const int most : {1, 2, 5, 8}) {
    const auto regions = CutRegions(pending_, *state, most, 1);
    EXPECT_LE(regions.size(), static_cast<std::size_t>(most));
    EXPECT_GE(regions.size(), static_cast<std::size_t>(most) - 1);
    std::multiset<CubeIndex> cubes;
    for (const RefinementRegion& region : regions) cubes.insert(region.cubes().begin(), region.cubes().end());
    EXPECT_EQ(cubes.size(), 18u);
    EXPECT_EQ(std::set<CubeIndex>(cubes.begin(), cubes.end()).size(), 18u);
  }
  EXPECT_EQ(CutRegions(pending_, *state, 8, 1000).size(), 1u);
}

}  // namespace
}  // namespace dhpmap
