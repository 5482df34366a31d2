// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/background_refinement.h"

#include <gtest/gtest.h>

#include <thread>
#include <utility>
#include <vector>

#include "tests/support/eventually.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

using testing::RandomMap;

std::shared_ptr<const MapSnapshot> SettledState() {
  Map map = RandomMap(1);
  for (const SubmapId id : testing::AllIds(map)) map.FindMutable(id)->mutable_info().activity = Activity::kInactive;
  return map.Freeze();
}

std::vector<std::weak_ptr<const TsdfBlock>> BlocksOf(const MapSnapshot& state) {
  std::vector<std::weak_ptr<const TsdfBlock>> blocks;
  for (const auto& submap : state.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) blocks.emplace_back(entry.tsdf);
  }
  return blocks;
}

TEST(BackgroundRefinement, KeepsNothingButMarksOfTheStateItBeganWithOnceItIsReady) {
  auto before = SettledState();
  const std::weak_ptr<const MapSnapshot> state = before;
  const auto blocks = BlocksOf(*before);
  BackgroundRefinement refinement;
  refinement.Start(std::move(before), {}, 1);
  ASSERT_TRUE(testing::Eventually([&] { return refinement.IsReady(); }));
  EXPECT_TRUE(state.expired()) << "though nobody has taken the outcome yet";
  const auto outcome = refinement.Take();
  ASSERT_TRUE(outcome);
  ASSERT_FALSE(outcome->changes.written.empty());
  for (const RefinedSubmap& submap : outcome->changes.written) {
    for (const BlockEntry& entry : submap.written) EXPECT_FALSE(outcome->changes.before->Has(submap.id, entry));
  }
  for (const auto& block : blocks) EXPECT_TRUE(block.expired());
}

TEST(BackgroundRefinement, MakesOfAStateWhatRefiningItWithoutMoreAdoMakes) {
  const auto before = SettledState();
  Map expected(before), map(before);
  ThreadPool pool(1);
  const RefinementReport report = RefineMap(expected, pool);
  BackgroundRefinement refinement;
  refinement.Start(before, {}, 1);
  const auto outcome = refinement.Take();
  ASSERT_TRUE(outcome);
  EXPECT_GT(report.management.num_moved_voxels, 0);
  EXPECT_EQ(outcome->report.management.num_moved_voxels, report.management.num_moved_voxels);
  EXPECT_EQ(AdoptRefinement(outcome->changes, map), 0);
  EXPECT_TRUE(testing::MapsAreEqual(*map.Freeze(), *expected.Freeze()));
}

}  // namespace
}  // namespace dhpmap
