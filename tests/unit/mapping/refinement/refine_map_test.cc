// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/refine_map.h"

#include <gtest/gtest.h>

#include "mapping/evidence/submap_labels.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

using testing::AddSubmap;
using testing::AllIds;
using testing::Put;
using testing::RandomMap;

Map WithSwitches(bool management, bool crf) {
  Map map = RandomMap(3);
  for (const SubmapId id : AllIds(map)) map.FindMutable(id)->mutable_info().activity = Activity::kInactive;
  map.mutable_info().config.refinement.management = management;
  map.mutable_info().config.refinement.crf = crf;
  return map;
}

TEST(RefineMap, SwitchedOffChangesNothing) {
  Map map = WithSwitches(false, false);
  const auto before = map.Publish(0);
  ThreadPool pool(2);
  RefineMap(map, pool);
  EXPECT_EQ(map.Publish(0), before);
}

TEST(RefineMap, LeavesActiveThingsAlone) {
  Map map = WithSwitches(true, true);
  std::vector<SubmapId> things;
  for (const SubmapId id : AllIds(map)) {
    if (map.Find(id)->info().panoptic != Panoptic::kThing) continue;
    map.FindMutable(id)->mutable_info().activity = Activity::kActive;
    things.push_back(id);
  }
  const auto before = map.Publish(0);
  ThreadPool pool(2);
  RefineMap(map, pool);
  ASSERT_FALSE(things.empty());
  for (const SubmapId id : things) EXPECT_EQ(map.Find(id), before->Find(id));
}

TEST(RefineMap, AnyNumberOfThreadsGivesTheSameBits) {
  Map one = WithSwitches(true, true), three = WithSwitches(true, true);
  ThreadPool single(1), several(3);
  RefineMap(one, single);
  RefineMap(three, several);
  EXPECT_TRUE(testing::MapsAreEqual(*one.Publish(0), *three.Publish(0)));
}

TEST(DropVoxelLabels, SavesBytesAndKeepsTheSubmapsLabels) {
  Map map = WithSwitches(true, false);
  ThreadPool pool(1);
  RefineMap(map, pool);
  const auto before = map.Publish(0);
  EXPECT_GT(DropVoxelLabels(map), 0);
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& was = before->Find(submap->id())->info();
    EXPECT_EQ(submap->info().class_id, was.class_id);
    EXPECT_EQ(submap->info().class_counts, was.class_counts);
    for (const BlockEntry& entry : submap->blocks().entries()) EXPECT_EQ(entry.labels, nullptr);
  }
}

TEST(DropVoxelLabels, ComeBackAsTheLabelOfTheSubmap) {
  Map map(testing::RandomMapInfo());
  Submap& submap = AddSubmap(map);
  Put(submap, {0, 0, 0}, 0.01f, 1.0f, {{{2, 6}}, {{kOwnInstance, 6}}});
  Put(submap, {1, 0, 0}, 0.01f, 1.0f, {{{1, 2}}, {{kOwnInstance, 2}}});
  RecomputeSubmapLabels(submap);
  submap.DropLabels();
  EXPECT_EQ(RestoreDroppedLabels(submap), 1);
  const LabelHistograms average{{{2, 4}}, {{kOwnInstance, 4}}};
  EXPECT_EQ(submap.blocks().entries().front().labels->Get(0), average);
  EXPECT_EQ(submap.blocks().entries().front().labels->Get(1), average);
  EXPECT_TRUE(submap.blocks().entries().front().labels->IsEmpty(2));
}

}  // namespace
}  // namespace dhpmap
