// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_management.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "tests/support/map_equality.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

constexpr int kNumClasses = 4;
constexpr int kSpan_vox = 12;  // voxels per axis in which random submaps overlap, across block borders

MapInfo Info() {
  MapInfo info;
  info.name = "m";
  info.label_set = testing::MakeLabelSet(2, 2);
  return info;
}

Submap& AddSubmap(Map& map, Panoptic panoptic = Panoptic::kThing) {
  SubmapInfo info;
  info.panoptic = panoptic;
  info.class_id = ClassId(1);
  info.voxel_size_m = map.info().config.voxel_size_m;
  info.truncation_m = map.info().config.truncation_m;
  return map.Create(std::move(info));
}

void Put(Submap& submap, VoxelIndex v, float distance_m, float weight, const LabelHistograms& labels) {
  const int i = LinearIndex(v);
  TsdfBlock& tsdf = submap.MutableTsdf(BlockOf(v));
  tsdf.distance_m[static_cast<std::size_t>(i)] = distance_m;
  tsdf.weight[static_cast<std::size_t>(i)] = weight;
  tsdf.color[static_cast<std::size_t>(i)] = {100, 150, 200};
  if (submap.id() != kUnknownSubmap) submap.MutableLabels(BlockOf(v)).Add(i, labels);
}

/// Several submaps, the unknown one too, that overlap at random, with counts for each other and for ids long gone.
Map RandomMap(unsigned seed) {
  std::mt19937 random(seed);
  const auto pick = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  Map map(Info());
  const int num_submaps = pick(2, 6);
  for (int s = 0; s < num_submaps; ++s) AddSubmap(map, s % 2 == 0 ? Panoptic::kThing : Panoptic::kStuff);
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) ids.push_back(submap->id());
  for (const SubmapId id : ids) {
    Submap& submap = *map.FindMutable(id);
    for (int n = 0; n < 400; ++n) {
      const VoxelIndex v{pick(-kSpan_vox, kSpan_vox), pick(-3, 3), pick(-3, 3)};
      const BlockEntry* entry = submap.blocks().Find(BlockOf(v));
      if (entry && entry->tsdf && entry->tsdf->IsObserved(LinearIndex(v))) continue;
      LabelHistograms labels;
      const auto count = static_cast<std::uint32_t>(pick(1, 30));
      labels.classes = {{static_cast<std::uint32_t>(pick(1, kNumClasses)), count}};
      labels.instances = {{0, count}};
      if (pick(0, 3) == 0) {
        const auto other = static_cast<std::uint32_t>(pick(1, num_submaps + 2));  // may be gone, or itself
        if (other != id.value) {
          const auto more = static_cast<std::uint32_t>(pick(1, 60));
          labels.instances.push_back({other, more});
          labels.classes = SumCounts(labels.classes, std::vector<LabelCount>{{1, more}});
        }
      }
      // Dyadic weights add up without rounding in any order.
      Put(submap, v, 0.01f * static_cast<float>(pick(-8, 8)), 0.25f * static_cast<float>(pick(1, 40)), labels);
    }
    submap.UpdateBoundingSphere();
  }
  return map;
}

std::vector<SubmapId> AllIds(const Map& map) {
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) ids.push_back(submap->id());
  return ids;
}

struct Totals {
  std::map<std::uint32_t, std::uint64_t> classes, instances;
  double weight = 0;
  bool operator==(const Totals&) const = default;
};

template <typename Visit>
void ForEachVoxel(const Map& map, Visit&& visit) {
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (entry.tsdf->IsObserved(i)) visit(*submap, entry, i);
      }
    }
  }
}

Totals Sum(const Map& map) {
  Totals totals;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    totals.weight += entry.tsdf->weight[static_cast<std::size_t>(i)];
    if (!entry.labels) return;
    const LabelHistograms labels = entry.labels->Get(i);
    for (const LabelCount& c : labels.classes) totals.classes[c.id] += c.count;
    for (const LabelCount& c : labels.instances) totals.instances[c.id == 0 ? submap.id().value : c.id] += c.count;
  });
  return totals;
}

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
    for (const LabelCount& c : entry.labels->Get(i).instances) own = c.id == 0 ? c.count : own;
    for (const LabelCount& c : entry.labels->Get(i).instances) {
      if (c.id == 0 || map.Find(SubmapId(c.id)) == nullptr) continue;
      EXPECT_TRUE(own > c.count || (own == c.count && submap.id().value < c.id));
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
  Map map(Info());
  Put(AddSubmap(map), {0, 0, 0}, 0.02f, 3.0f, {{{1, 2}}, {{0, 2}}});
  Put(AddSubmap(map), {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{0, 9}}});
  ThreadPool pool(1);
  const ManagementReport report = ManageLabels(AllIds(map), map, pool);
  EXPECT_EQ(report.num_shared_voxels, 1);
  EXPECT_EQ(report.num_removed_submaps, 1);
  EXPECT_EQ(map.Find(SubmapId(1)), nullptr);
  const BlockEntry& entry = map.Find(SubmapId(2))->blocks().entries()[0];
  EXPECT_FLOAT_EQ(entry.tsdf->distance_m[0], 0.03f);
  EXPECT_FLOAT_EQ(entry.tsdf->weight[0], 4.0f);
  EXPECT_EQ(entry.labels->Get(0), (LabelHistograms{{{1, 2}, {2, 9}}, {{0, 9}, {1, 2}}}));
}

TEST(LabelManagement, LeavesSubmapsAloneThatAreNotNamed) {
  Map map(Info());
  Put(AddSubmap(map), {0, 0, 0}, 0.02f, 3.0f, {{{1, 2}}, {{0, 2}}});
  Put(AddSubmap(map), {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{0, 9}}});
  const auto before = map.Publish(0);
  ThreadPool pool(1);
  ManageLabels(std::vector<SubmapId>{SubmapId(1)}, map, pool);
  EXPECT_EQ(map.Publish(0), before);
}

TEST(LabelManagement, MovedSubmapsAndOtherVoxelSizesNeverMerge) {
  Map map(Info());
  Put(AddSubmap(map), {0, 0, 0}, 0.02f, 3.0f, {{{1, 2}}, {{0, 2}}});
  Submap& moved = AddSubmap(map);
  Put(moved, {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{0, 9}}});
  moved.mutable_info().T_map_submap.translation().x() = 0.04;
  Submap& finer = AddSubmap(map);
  Put(finer, {0, 0, 0}, 0.06f, 1.0f, {{{2, 9}}, {{0, 9}}});
  finer.mutable_info().voxel_size_m = 0.02;
  const auto before = map.Publish(0);
  ThreadPool pool(1);
  EXPECT_EQ(ManageLabels(AllIds(map), map, pool).num_skipped_submaps, 2);
  EXPECT_EQ(map.Publish(0), before);
}

TEST(LabelManagement, UnknownGeometryGoesToTheObjectThatIsThere) {
  Map map(Info());
  Put(*map.FindMutable(kUnknownSubmap), {0, 0, 0}, 0.02f, 3.0f, {});
  Put(*map.FindMutable(kUnknownSubmap), {1, 0, 0}, 0.02f, 3.0f, {});
  Put(AddSubmap(map), {0, 0, 0}, 0.06f, 1.0f, {{{2, 1}}, {{0, 1}}});
  ThreadPool pool(1);
  ManageLabels(AllIds(map), map, pool);
  EXPECT_FLOAT_EQ(map.Find(SubmapId(1))->blocks().entries()[0].tsdf->weight[0], 4.0f);
  const TsdfBlock& unknown = *map.Find(kUnknownSubmap)->blocks().entries()[0].tsdf;
  EXPECT_FALSE(unknown.IsObserved(0));
  EXPECT_TRUE(unknown.IsObserved(1));
}

}  // namespace
}  // namespace dhpmap
