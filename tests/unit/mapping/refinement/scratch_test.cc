// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "mapping/base/refinement_scratch.h"
#include "mapping/evidence/stray_voxels.h"
#include "mapping/refinement/near_evidence.h"
#include "mapping/refinement/refinement_round.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

std::size_t ScratchNow() { return CountOf(MemoryKind::kRefinement).now_bytes(); }

Map RefinableMap(unsigned seed) {
  Map map = testing::RandomMap(seed);
  for (const SubmapId id : testing::AllIds(map)) map.FindMutable(id)->mutable_info().activity = Activity::kInactive;
  return map;
}

/// What a tile is solved with, in the same kinds of arrays.
TEST(RefinementScratch, OfATileIsNoLessThanItsVoxelsTake) {
  Map map = RefinableMap(3);
  ThreadPool pool(1);
  {
    const KnownInstances known(testing::AllIds(map), map);
    const auto blocks = CollectBlocks(testing::AllIds(map), map);
    EXPECT_GE(ScratchNow(), blocks.size() * sizeof(HeldBlock));
    const std::vector<CrfTile> tiles = CutTiles(blocks, known, 8, 1, pool);
    ASSERT_FALSE(tiles.empty());
    const std::size_t before = ScratchNow();
    const TileProblem problem(blocks, known, tiles[0], 1, map.info().config.voxel_size_m);
    const std::size_t num_members = problem.members().size();
    const auto num_channels = static_cast<std::size_t>(problem.channels().num_channels());
    EXPECT_GE(ScratchNow(), before + num_members * sizeof(TileProblem::Member));
    const std::size_t with_problem = ScratchNow();
    const auto evidence = GatherEvidence(problem, 3, map.info().config.voxel_size_m);
    EXPECT_EQ(ScratchNow(), with_problem + num_members * num_channels * sizeof(float)) << "what found it is gone";
  }
  EXPECT_EQ(ScratchNow(), 0u);
}

class ScratchOfARefinement : public ::testing::TestWithParam<int> {
 protected:
  ThreadPool pool_{GetParam()};
  Map map_ = RefinableMap(3);
  std::atomic<std::size_t> most_seen_ = 0;
  std::atomic<int> num_asked_ = 0;

  void Look() {
    ++num_asked_;
    most_seen_ = std::max<std::size_t>(most_seen_, ScratchNow());
  }
};

TEST_P(ScratchOfARefinement, IsCountedMeanwhileAndZeroAfterwards) {
  ASSERT_EQ(ScratchNow(), 0u);
  const RefinementReport report = RefineMap(map_, pool_, nullptr, [this] {
    Look();
    return false;
  });
  EXPECT_GT(report.crf.num_voxels, 0);
  EXPECT_GT(most_seen_, 0u);
  EXPECT_EQ(ScratchNow(), 0u);
  EXPECT_GT(CountOf(MemoryKind::kRefinement).most_bytes(), 0u);
}

TEST_P(ScratchOfARefinement, IsZeroAfterOneThatWasStoppedInTheMiddle) {
  RefineMap(map_, pool_, nullptr, [this] {
    Look();
    return most_seen_ > 0;  // so it is among the tiles
  });
  EXPECT_GT(most_seen_, 0u);
  EXPECT_EQ(ScratchNow(), 0u);
}

TEST_P(ScratchOfARefinement, IsZeroAfterAnException) {
  const auto refine = [this] {
    RefineMap(map_, pool_, nullptr, [this] {
      Look();
      if (most_seen_ > 0) throw std::runtime_error("among the tiles");
      return false;
    });
  };
  EXPECT_THROW(refine(), std::runtime_error);
  EXPECT_GT(most_seen_, 0u);
  EXPECT_EQ(ScratchNow(), 0u);
}

TEST_P(ScratchOfARefinement, IsZeroBetweenTheStepsOfARound) {
  RefinementRound round;
  round.Begin(*map_.Publish(0), 3, 1);
  int num_steps = 0;
  for (; !round.IsFinished(); ++num_steps) {
    const RegionPart part = round.NextPart();
    Map step = GoOnFrom(*map_.published(), part);
    round.RefineNext(step, pool_);
    EXPECT_EQ(ScratchNow(), 0u) << num_steps;
  }
  EXPECT_GT(num_steps, 1);
}

TEST_P(ScratchOfARefinement, OfStrayVoxelsIsCountedAndZeroAfterwards) {
  constexpr int kBlocks = 400;  // a thing's are known with a flag for each voxel: more than all else of this map takes
  Submap& large = testing::AddSubmap(map_);
  large.mutable_info().activity = Activity::kInactive;
  for (int i = 0; i < kBlocks; ++i)
    testing::Put(large, {100 + kBlockSide * i, 0, 0}, 0.01f, 1.0f, {{{1, 2}}, {{kOwnInstance, 2}}});
  AbsorbStrayVoxels(testing::AllIds(map_), map_, pool_);
  EXPECT_EQ(ScratchNow(), 0u);
  EXPECT_GE(CountOf(MemoryKind::kRefinement).most_bytes(), std::size_t{kBlocks} * kBlockVoxels);
}

INSTANTIATE_TEST_SUITE_P(Threads, ScratchOfARefinement, ::testing::Values(1, 3));

}  // namespace
}  // namespace dhpmap
