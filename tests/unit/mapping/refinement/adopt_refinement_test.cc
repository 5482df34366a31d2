// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/adopt_refinement.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "mapping/refinement/refine_map.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/evidence/random_map.h"
#include "tests/unit/mapping/refinement/adopt_by_states.h"

namespace dhpmap {
namespace {

using testing::AllIds;
using testing::ForEachVoxel;
using testing::MapsAreEqual;
using testing::Put;
using testing::RandomMap;
using testing::Sum;

/// A random map of settled submaps, a state frozen from it, and what label management makes of that.
class Adoption : public ::testing::TestWithParam<unsigned> {
 protected:
  Adoption() {
    for (const SubmapId id : AllIds(map_)) map_.FindMutable(id)->mutable_info().activity = Activity::kInactive;
    before_ = map_.Freeze();
    Map side(before_);
    ManageLabels(AllIds(side), side, pool_);
    refined_ = side.Freeze();
  }

  /// New observations in a few voxels, as fusion would make them.
  std::set<BlockIndex> Write(int num_voxels) {
    std::set<BlockIndex> written;
    std::mt19937 random(GetParam() + 100);
    const std::vector<SubmapId> ids = AllIds(map_);
    for (int n = 0; n < num_voxels; ++n) {
      const SubmapId id = ids[1 + random() % (ids.size() - 1)];
      const VoxelIndex v{static_cast<int>(random() % 20) - 10, 0, static_cast<int>(random() % 6) - 3};
      Put(*map_.FindMutable(id), v, 0.01f, 1.0f, {{{1, 1}}, {{kOwnInstance, 1}}});
      written.insert(BlockOf(v));
    }
    return written;
  }

  std::int64_t Adopt(Map& map) const {
    return AdoptRefinement(OutcomeOf(std::make_shared<const StateMarks>(*before_), *refined_), map);
  }

  ThreadPool pool_{2};
  Map map_ = RandomMap(GetParam());
  std::shared_ptr<const MapSnapshot> before_, refined_;
};

TEST_P(Adoption, TakesAllWhereNothingHappenedMeanwhile) {
  EXPECT_EQ(Adopt(map_), 0);
  EXPECT_TRUE(MapsAreEqual(*refined_, *map_.Freeze()));
}

TEST_P(Adoption, LosesNoCountAndNoWeightOfWhatCameMeanwhile) {
  Write(5);
  const auto sum = Sum(map_);
  Adopt(map_);
  EXPECT_EQ(Sum(map_), sum);
}

TEST_P(Adoption, BlocksWrittenMeanwhileStayAsTheyAreNow) {
  const std::set<BlockIndex> written = Write(2);
  const auto now = map_.Freeze();
  EXPECT_GT(Adopt(map_), 0);
  for (const auto& submap : map_.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      const Submap& source = written.contains(entry.index) ? *now->Find(submap->id()) : *refined_->Find(submap->id());
      const BlockEntry* expected = source.blocks().Find(entry.index);
      ASSERT_NE(expected, nullptr);
      EXPECT_EQ(entry.tsdf, expected->tsdf);
      EXPECT_EQ(entry.labels, expected->labels);
    }
  }
}

TEST_P(Adoption, PositionsNobodyWroteAreHeldOnce) {
  const std::set<BlockIndex> written = Write(2);
  Adopt(map_);
  std::set<VoxelIndex> held;
  ForEachVoxel(map_, [&](const Submap&, const BlockEntry& entry, int i) {
    if (written.contains(entry.index)) return;
    EXPECT_TRUE(held.insert(VoxelIn(entry.index, i)).second);
  });
}

TEST_P(Adoption, WhatWasDeletedMeanwhileStaysDeletedAndTakesNobodyElsesVoxelsAlong) {
  const SubmapId victim = AllIds(map_).back();
  map_.Remove(victim);
  const auto sum = Sum(map_);
  Adopt(map_);
  EXPECT_EQ(map_.Find(victim), nullptr);
  EXPECT_EQ(Sum(map_), sum);
}

TEST_P(Adoption, WhatWasMovedMeanwhileKeepsItsVoxels) {
  const SubmapId moved = AllIds(map_).back();
  map_.FindMutable(moved)->mutable_info().T_map_submap.translation().x() = 1.0;
  const auto own = map_.Freeze()->Find(moved)->blocks().size();
  const auto sum = Sum(map_);
  Adopt(map_);
  ASSERT_NE(map_.Find(moved), nullptr);
  EXPECT_EQ(map_.Find(moved)->blocks().size(), own);
  EXPECT_EQ(Sum(map_), sum);
}

TEST_P(Adoption, WhatWasLockedMeanwhileStaysAsItIs) {
  const SubmapId locked = AllIds(map_).back();
  map_.FindMutable(locked)->mutable_info().is_locked = true;
  const auto now = map_.Freeze();
  const auto sum = Sum(map_);
  Adopt(map_);
  ASSERT_NE(map_.Find(locked), nullptr);
  EXPECT_TRUE(testing::SubmapsAreEqual(*now->Find(locked), *map_.Find(locked)));
  EXPECT_EQ(Sum(map_), sum);
}

TEST_P(Adoption, ActiveThingsAreNoHindrance) {
  testing::AddSubmap(map_);
  Put(*map_.FindMutable(AllIds(map_).back()), {0, 0, 0}, 0.01f, 1.0f, {{{1, 1}}, {{kOwnInstance, 1}}});
  EXPECT_EQ(Adopt(map_), 0);
}

/// Some of what may happen to a map while it is refined.
void GoOn(std::mt19937& random, Map& map) {
  const auto pick = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const std::vector<SubmapId> ids = AllIds(map);
  const SubmapId id = ids[static_cast<std::size_t>(pick(0, static_cast<int>(ids.size()) - 1))];
  const BlockIndex block{pick(-2, 1), pick(-1, 0), pick(-1, 0)};
  Submap& submap = *map.FindMutable(id);
  switch (pick(0, 12)) {
    case 0: map.Remove(id); break;
    case 1: map.Clone(id); break;
    case 2: submap.mutable_info().T_map_submap.translation().y() = 0.5; break;
    case 3: submap.EraseBlock(block); break;
    case 4: submap.mutable_info().activity = Activity::kActive; break;
    case 5:
      if (submap.blocks().Find(block) != nullptr) submap.MutableGone(block).Set(7, 1);
      break;
    case 6: submap.mutable_info().edited_revision = map.info().revision + 1; break;
    case 7: submap.mutable_info().is_placed = true; break;
    case 8: submap.mutable_info().is_locked = true; break;
    default: Put(submap, VoxelIn(block, pick(0, kBlockVoxels - 1)), 0.01f, 1.0f, {{{1, 1}}, {{kOwnInstance, 1}}});
  }
}

/// As MapsAreEqual, and the very same layers in the same order of tiles.
void ExpectSame(const MapSnapshot& a, const MapSnapshot& b) {
  ASSERT_TRUE(MapsAreEqual(a, b));
  for (const auto& submap : a.submaps()) {
    const Submap& other = *b.Find(submap->id());
    EXPECT_EQ(submap->info().revision, other.info().revision);
    ASSERT_EQ(submap->blocks().tiles().size(), other.blocks().tiles().size());
    auto expected = other.blocks().entries().begin();
    for (const BlockEntry& entry : submap->blocks().entries()) {
      EXPECT_EQ(entry.index, expected->index);
      EXPECT_EQ(entry.tsdf, expected->tsdf);
      EXPECT_EQ(entry.labels, expected->labels);
      EXPECT_EQ(entry.gone, expected->gone);
      ++expected;
    }
  }
}

TEST_P(Adoption, ByMarksIsAdoptionByTheStatesThemselves) {
  std::mt19937 random(GetParam());
  for (int num_events = 0; num_events < 12; ++num_events) {
    Map by_marks = map_.Fork();
    for (int n = 0; n < num_events; ++n) GoOn(random, by_marks);
    by_marks.Publish(1);
    Map by_states = by_marks.Fork();
    EXPECT_EQ(Adopt(by_marks), testing::AdoptByStates(*before_, *refined_, by_states));
    ExpectSame(*by_marks.Publish(2), *by_states.Publish(2));
  }
}

TEST_P(Adoption, AnOutcomeKeepsNothingOfTheStateItBeganWith) {
  std::vector<std::weak_ptr<const TsdfBlock>> began_with;
  for (const auto& submap : before_->submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) began_with.emplace_back(entry.tsdf);
  }
  const RefinementOutcome outcome = OutcomeOf(std::make_shared<const StateMarks>(*before_), *refined_);
  ASSERT_FALSE(outcome.written.empty());
  map_ = Map(testing::RandomMapInfo());
  before_ = refined_ = nullptr;
  for (const auto& block : began_with) EXPECT_TRUE(block.expired());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Adoption, ::testing::Range(0u, 8u));

}  // namespace
}  // namespace dhpmap
