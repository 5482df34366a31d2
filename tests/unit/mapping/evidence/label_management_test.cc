// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/label_management.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "tests/support/map_equality.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

using testing::AddSubmap;
using testing::AllIds;
using testing::ForEachVoxel;
using testing::Put;
using testing::RandomMap;
using testing::Sum;
using testing::Totals;

Map EmptyMap() { return Map(testing::RandomMapInfo()); }

class RandomMaps : public ::testing::TestWithParam<unsigned> {
 protected:
  ThreadPool pool_{2};
};

TEST_P(RandomMaps, EveryPositionIsHeldOnceAndNoneIsLost) {
  Map map = RandomMap(GetParam());
  std::set<VoxelIndex> before, after;
  ForEachVoxel(map, [&](const Submap&, const BlockEntry& e, int i) { before.insert(VoxelIn(e.index, i)); });
  ManageLabels(AllIds(map), map, pool_);
  ForEachVoxel(map, [&](const Submap&, const BlockEntry& e, int i) {
    EXPECT_TRUE(after.insert(VoxelIn(e.index, i)).second) << "held twice";
  });
  EXPECT_EQ(after, before);
}

TEST_P(RandomMaps, CountsAndWeightAreConserved) {
  Map map = RandomMap(GetParam());
  const Totals before = Sum(map);
  ManageLabels(AllIds(map), map, pool_);
  EXPECT_EQ(Sum(map), before);
}

TEST_P(RandomMaps, EveryVoxelIsInTheSubmapOfItsWinningInstance) {
  Map map = RandomMap(GetParam());
  ManageLabels(AllIds(map), map, pool_);
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    if (!entry.labels || entry.labels->IsEmpty(i)) return;
    std::uint64_t own = 0;
    for (const InstanceCount& c : entry.labels->Get(i).instances) own = c.id.IsOwn() ? c.count : own;
    for (const InstanceCount& c : entry.labels->Get(i).instances) {
      const SubmapId instance = c.id.In(submap.id());
      if (c.id.IsOwn() || map.Find(instance) == nullptr) continue;
      EXPECT_TRUE(own > c.count || (own == c.count && submap.id() < instance));
    }
  });
}

TEST_P(RandomMaps, SecondRunChangesNothing) {
  Map map = RandomMap(GetParam());
  ManageLabels(AllIds(map), map, pool_);
  const auto once = map.Publish(0);
  const ManagementReport again = ManageLabels(AllIds(map), map, pool_);
  EXPECT_EQ(again.num_shared_voxels + again.num_moved_voxels + again.num_removed_submaps, 0);
  EXPECT_EQ(map.Publish(0), once);
}

TEST_P(RandomMaps, AnyNumberOfThreadsGivesTheSameBits) {
  Map one = RandomMap(GetParam()), three = RandomMap(GetParam());
  ThreadPool single(1), several(3);
  ManageLabels(AllIds(one), one, single);
  ManageLabels(AllIds(three), three, several);
  EXPECT_TRUE(testing::MapsAreEqual(*one.Publish(0), *three.Publish(0)));
}

TEST_P(RandomMaps, SubmapTotalsAreThoseOfTheirVoxels) {
  Map map = RandomMap(GetParam());
  ManageLabels(AllIds(map), map, pool_);
  std::map<SubmapId, std::map<std::uint16_t, std::uint64_t>> truth;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    for (const LabelCount& c : entry.labels ? entry.labels->Get(i).classes : std::vector<LabelCount>()) {
      truth[submap.id()][static_cast<std::uint16_t>(c.id)] += c.count;
    }
  });
  for (const auto& submap : map.submaps()) {
    if (submap->id() == kUnknownSubmap) continue;
    std::map<std::uint16_t, std::uint64_t> totals;
    for (const ClassTotal& total : submap->info().class_counts) totals[total.id.value] = total.count;
    EXPECT_EQ(totals, truth[submap->id()]);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMaps, ::testing::Range(0u, 12u));

TEST(LabelManagement, MergesGeometryByWeight) {
  Map map = EmptyMap();
  Put(AddSubmap(map), {0, 0, 0}, 0.02f, 3.0f, {{{1, 2}}, {{kOwnInstance, 2}}});
  Put(AddSubmap(map), {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{kOwnInstance, 9}}});
  ThreadPool pool(1);
  const ManagementReport report = ManageLabels(AllIds(map), map, pool);
  EXPECT_EQ(report.num_shared_voxels, 1);
  EXPECT_EQ(report.num_removed_submaps, 1);
  EXPECT_EQ(map.Find(SubmapId(1)), nullptr);
  const BlockEntry& entry = map.Find(SubmapId(2))->blocks().entries().front();
  EXPECT_FLOAT_EQ(entry.tsdf->distance_m[0], 0.03f);
  EXPECT_FLOAT_EQ(entry.tsdf->weight[0], 4.0f);
  EXPECT_EQ(entry.labels->Get(0),
            (LabelHistograms{{{1, 2}, {2, 9}}, {{kOwnInstance, 9}, {SeenInstance(SubmapId(1)), 2}}}));
}

TEST(LabelManagement, LeavesSubmapsAloneThatAreNotNamed) {
  Map map = EmptyMap();
  Put(AddSubmap(map), {0, 0, 0}, 0.02f, 3.0f, {{{1, 2}}, {{kOwnInstance, 2}}});
  Put(AddSubmap(map), {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{kOwnInstance, 9}}});
  const auto before = map.Publish(0);
  ThreadPool pool(1);
  ManageLabels(std::vector<SubmapId>{SubmapId(1)}, map, pool);
  EXPECT_EQ(map.Publish(0), before);
}

TEST(LabelManagement, MovedSubmapsAndOtherVoxelSizesNeverMerge) {
  Map map = EmptyMap();
  Put(AddSubmap(map), {0, 0, 0}, 0.02f, 3.0f, {{{1, 2}}, {{kOwnInstance, 2}}});
  Submap& moved = AddSubmap(map);
  Put(moved, {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{kOwnInstance, 9}}});
  moved.mutable_info().T_map_submap.translation().x() = 0.04;
  Submap& finer = AddSubmap(map);
  Put(finer, {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{kOwnInstance, 9}}});
  finer.mutable_info().voxel_size_m = 0.02;
  const auto before = map.Publish(0);
  ThreadPool pool(1);
  EXPECT_EQ(ManageLabels(AllIds(map), map, pool).num_skipped_submaps, 2);
  EXPECT_EQ(map.Publish(0), before);
}

TEST(LabelManagement, UnknownGeometryGoesToTheObjectThatIsThere) {
  Map map = EmptyMap();
  Put(*map.FindMutable(kUnknownSubmap), {0, 0, 0}, 0.02f, 3.0f, {});
  Put(*map.FindMutable(kUnknownSubmap), {1, 0, 0}, 0.02f, 3.0f, {});
  Put(AddSubmap(map), {0, 0, 0}, 0.06f, 1.0f, {{{2, 1}}, {{kOwnInstance, 1}}});
  ThreadPool pool(1);
  ManageLabels(AllIds(map), map, pool);
  EXPECT_FLOAT_EQ(map.Find(SubmapId(1))->blocks().entries().front().tsdf->weight[0], 4.0f);
  const TsdfBlock& unknown = *map.Find(kUnknownSubmap)->blocks().entries().front().tsdf;
  EXPECT_FALSE(unknown.IsObserved(0));
  EXPECT_TRUE(unknown.IsObserved(1));
}

TEST_P(RandomMaps, WhatIsContradictedStaysAndHasNoSay) {
  Map map = RandomMap(GetParam()), without = RandomMap(GetParam());
  // Every third voxel of each submap: contradicted in one map, never observed in the other.
  std::vector<std::tuple<SubmapId, BlockIndex, int>> contradicted;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    if ((i + static_cast<int>(submap.id().value)) % 3 == 0) contradicted.emplace_back(submap.id(), entry.index, i);
  });
  for (const auto& [id, index, i] : contradicted) {
    map.FindMutable(id)->MutableGone(index).Set(i, GoneBlock::kContradicted);
    Submap& other = *without.FindMutable(id);
    other.MutableTsdf(index).weight[static_cast<std::size_t>(i)] = 0;
    if (other.blocks().Find(index)->labels != nullptr) other.MutableLabels(index).Clear(i);
  }
  const auto before = map.Publish(0);
  ManageLabels(AllIds(map), map, pool_);
  ManageLabels(AllIds(without), without, pool_);
  std::set<std::pair<SubmapId, VoxelIndex>> shown, expected;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    if (entry.Shows(i)) shown.emplace(submap.id(), VoxelIn(entry.index, i));
  });
  ForEachVoxel(without, [&](const Submap& submap, const BlockEntry& entry, int i) {
    expected.emplace(submap.id(), VoxelIn(entry.index, i));
  });
  EXPECT_EQ(shown, expected);
  std::size_t num_kept = 0;
  for (const auto& [id, index, i] : contradicted) {
    const BlockEntry* entry = map.Find(id) ? map.Find(id)->blocks().Find(index) : nullptr;
    ASSERT_TRUE(entry != nullptr && entry->tsdf->IsObserved(i)) << "nothing that was observed is lost";
    if (entry->Shows(i)) continue;  // it was given the voxel, which others hold
    ++num_kept;
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(entry->tsdf->weight[at], before->Find(id)->blocks().Find(index)->tsdf->weight[at]);
  }
  EXPECT_GT(num_kept, contradicted.size() / 2);
}

}  // namespace
}  // namespace dhpmap
