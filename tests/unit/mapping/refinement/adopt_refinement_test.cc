// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "mapping/refinement/refine_map.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/refinement/random_map.h"

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
      Put(*map_.FindMutable(id), v, 0.01f, 1.0f, {{{1, 1}}, {{0, 1}}});
      written.insert(BlockOf(v));
    }
    return written;
  }

  ThreadPool pool_{2};
  Map map_ = RandomMap(GetParam());
  std::shared_ptr<const MapSnapshot> before_, refined_;
};

TEST_P(Adoption, TakesAllWhereNothingHappenedMeanwhile) {
  EXPECT_EQ(AdoptRefinement(*before_, *refined_, map_), 0);
  EXPECT_TRUE(MapsAreEqual(*refined_, *map_.Freeze()));
}

TEST_P(Adoption, LosesNoCountAndNoWeightOfWhatCameMeanwhile) {
  Write(5);
  const auto sum = Sum(map_);
  AdoptRefinement(*before_, *refined_, map_);
  EXPECT_EQ(Sum(map_), sum);
}

TEST_P(Adoption, BlocksWrittenMeanwhileStayAsTheyAreNow) {
  const std::set<BlockIndex> written = Write(2);
  const auto now = map_.Freeze();
  EXPECT_GT(AdoptRefinement(*before_, *refined_, map_), 0);
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
  AdoptRefinement(*before_, *refined_, map_);
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
  AdoptRefinement(*before_, *refined_, map_);
  EXPECT_EQ(map_.Find(victim), nullptr);
  EXPECT_EQ(Sum(map_), sum);
}

TEST_P(Adoption, WhatWasMovedMeanwhileKeepsItsVoxels) {
  const SubmapId moved = AllIds(map_).back();
  map_.FindMutable(moved)->mutable_info().T_map_submap.translation().x() = 1.0;
  const auto own = map_.Freeze()->Find(moved)->blocks().size();
  const auto sum = Sum(map_);
  AdoptRefinement(*before_, *refined_, map_);
  ASSERT_NE(map_.Find(moved), nullptr);
  EXPECT_EQ(map_.Find(moved)->blocks().size(), own);
  EXPECT_EQ(Sum(map_), sum);
}

TEST_P(Adoption, ActiveThingsAreNoHindrance) {
  testing::AddSubmap(map_);
  Put(*map_.FindMutable(AllIds(map_).back()), {0, 0, 0}, 0.01f, 1.0f, {{{1, 1}}, {{0, 1}}});
  EXPECT_EQ(AdoptRefinement(*before_, *refined_, map_), 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Adoption, ::testing::Range(0u, 8u));

}  // namespace
}  // namespace dhpmap
