// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/split_submap.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <tuple>

#include "mapping/evidence/submap_labels.h"
#include "mapping/objects/clear_region.h"
#include "mapping/objects/merge_submaps.h"
#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

MapInfo MapOfBench() { return testing::NamedMap("m", 3, 1); }

SubmapId AddBench(Map& map) {
  SubmapInfo info = testing::SettledThingOn(map, ClassId(1));
  info.display_name = "bench";
  return map.Create(std::move(info)).id();
}

void ObserveVoxel(VoxelIndex v, int seed, Map& map, SubmapId id) {
  Submap& submap = *map.FindMutable(id);
  const auto i = static_cast<std::size_t>(LinearIndex(v));
  TsdfBlock& tsdf = submap.MutableTsdf(BlockOf(v));
  tsdf.distance_m[i] = 0.001f * static_cast<float>(seed % 50);
  tsdf.weight[i] = static_cast<float>(1 + seed % 7);
  tsdf.color[i] = {static_cast<std::uint8_t>(seed % 251), 2, 3};
  const auto count = static_cast<std::uint32_t>(1 + seed % 5);
  LabelHistograms seen{{{static_cast<std::uint32_t>(1 + seed % 2), count}}, {{kOwnInstance, count}}};
  if (seed % 4 == 0) seen.instances.push_back({SeenInstance(SubmapId(99)), count + 1});  // held by conclusion
  submap.MutableLabels(BlockOf(v)).Set(LinearIndex(v), seen);
  submap.MutableLabels(BlockOf(v)).SetConcluded(LinearIndex(v), seed % 4 == 0);
  if (seed % 3 == 0) {
    const BlockEntry* entry = submap.blocks().Find(BlockOf(v));
    GoneBlock gone = entry->gone != nullptr ? *entry->gone : GoneBlock();
    gone.Set(LinearIndex(v), 1 + seed % 2);
    submap.PutGone(BlockOf(v), std::make_shared<const GoneBlock>(gone));
  }
  submap.AddClassObservations(ClassId(static_cast<std::uint16_t>(1 + seed % 2)), count);
}

/// Everything that is known of a place, whoever holds it.
using Known = std::tuple<float, float, int, std::uint64_t, int, bool>;
std::multimap<VoxelIndex, Known> KnownIn(const Map& map, const std::vector<SubmapId>& ids) {
  std::multimap<VoxelIndex, Known> known;
  for (const SubmapId id : ids) {
    for (const BlockEntry& entry : map.Find(id)->blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!entry.tsdf->IsObserved(i)) continue;
        const auto at = static_cast<std::size_t>(i);
        known.emplace(VoxelIn(entry.index, i),
                      Known{entry.tsdf->distance_m[at], entry.tsdf->weight[at], entry.tsdf->color[at].r,
                            entry.labels->NumObservations(i), entry.gone ? entry.gone->Count(i) : 0,
                            entry.labels->IsConcluded(i)});
      }
    }
  }
  return known;
}

std::uint64_t Total(const Map& map, const std::vector<SubmapId>& ids) {
  std::uint64_t total = 0;
  for (const SubmapId id : ids) {
    for (const ClassTotal& each : map.Find(id)->info().class_counts) total += each.count;
  }
  return total;
}

class Split : public ::testing::Test {
 protected:
  void SetUp() override {
    thing = AddBench(map);
    std::mt19937 random(7);
    // Two boxes of voxels that share a block and lie apart, and a speck.
    for (int x = 0; x < 10; ++x) {
      for (int y = 0; y < 4; ++y) {
        for (int z = 0; z < 4; ++z) {
          ObserveVoxel({x, y, z}, static_cast<int>(random() % 1000), map, thing);
          if (x < 6) ObserveVoxel({x + 13, y, z}, static_cast<int>(random() % 1000), map, thing);
        }
      }
    }
    ObserveVoxel({30, 30, 30}, 1, map, thing);
    map.FindMutable(thing)->UpdateBoundingSphere();
    RecomputeSubmapLabels(*map.FindMutable(thing));
    map.Publish(1);
  }
  Map map{MapOfBench()};
  SubmapId thing;
  const double voxel_m = map.info().config.voxel_size_m;
};

TEST_F(Split, ByAPlaneGivesEachVoxelToOneAndLosesNothing) {
  const auto before = KnownIn(map, {thing});
  const std::uint64_t total = Total(map, {thing});
  const double border_m = 5 * voxel_m;
  const auto part = SplitSubmap(
      thing, [&](const Eigen::Vector3d& p_m) { return p_m.x() > border_m; }, map);
  ASSERT_TRUE(part);
  EXPECT_EQ(KnownIn(map, {thing, *part}), before);
  EXPECT_EQ(Total(map, {thing, *part}), total);
  for (const auto& [voxel, known] : KnownIn(map, {thing})) EXPECT_LT(voxel.x, 5);
  for (const auto& [voxel, known] : KnownIn(map, {*part})) EXPECT_GE(voxel.x, 5);
  EXPECT_LT(map.Find(thing)->bounding_sphere().radius_m, 1.0);
  EXPECT_EQ(map.Find(*part)->info().display_name, "");
  EXPECT_EQ(map.info().pairs.Of(thing, *part).verdict, PairVerdict::kMustBeTwo);
}

TEST_F(Split, SharesWithSnapshotsOfBefore) {
  const auto snapshot = map.published();
  const auto before = KnownIn(map, {thing});
  ASSERT_TRUE(SplitSubmap(
      thing, [&](const Eigen::Vector3d& p_m) { return p_m.x() > 5 * voxel_m; }, map));
  Map as_it_was(snapshot);
  EXPECT_EQ(KnownIn(as_it_was, {thing}), before);
}

TEST_F(Split, ChangesNothingIfOnePartWouldBeEmpty) {
  EXPECT_FALSE(SplitSubmap(
      thing, [](const Eigen::Vector3d&) { return true; }, map));
  EXPECT_FALSE(SplitSubmap(
      thing, [](const Eigen::Vector3d&) { return false; }, map));
  EXPECT_EQ(map.Publish(2), map.published());
  EXPECT_EQ(map.info().revision, 1);
}

TEST_F(Split, ConnectedPartsBecomeObjectsButSpecksStay) {
  const auto before = KnownIn(map, {thing});
  const std::vector<SubmapId> made = SplitIntoConnectedParts(thing, 16, 10, map);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(KnownIn(map, {thing, made[0]}), before);
  EXPECT_EQ(KnownIn(map, {thing}).size(), 161u);
  EXPECT_EQ(KnownIn(map, {made[0]}).size(), 96u);
}

TEST_F(Split, OfNoMorePartsThanAskedFor) {
  EXPECT_EQ(SplitIntoConnectedParts(thing, 1, 3, map).size(), 2u);
  EXPECT_TRUE(SplitIntoConnectedParts(thing, 1, 1, map).empty());
}

TEST_F(Split, AndMergedAgainIsTheSameObject) {
  const auto before = KnownIn(map, {thing});
  const auto totals = map.Find(thing)->info().class_counts;
  const auto part = SplitSubmap(
      thing, [&](const Eigen::Vector3d& p_m) { return p_m.x() > 5 * voxel_m; }, map);
  ASSERT_TRUE(CanMerge(map, *part, thing));
  MergeSubmaps(*part, thing, map);
  EXPECT_EQ(KnownIn(map, {thing}), before);
  EXPECT_EQ(map.Find(thing)->info().class_counts, totals);
}

TEST_F(Split, WithoutLabelsObservationsGoWithTheVoxels) {
  map.FindMutable(thing)->DropLabels();
  const std::uint64_t total = Total(map, {thing});
  const auto part = SplitSubmap(
      thing, [&](const Eigen::Vector3d& p_m) { return p_m.x() > 12 * voxel_m; }, map);
  ASSERT_TRUE(part);
  EXPECT_EQ(Total(map, {thing, *part}), total);
  EXPECT_NEAR(static_cast<double>(Total(map, {*part})), static_cast<double>(total) * 97 / 257, 3);
}

TEST_F(Split, OfAMovedObjectStaysWithItsPose) {
  Transform T = Transform::Identity();
  T.translation() = Eigen::Vector3d(5, 0, 0);
  map.FindMutable(thing)->mutable_info().T_map_submap = T;
  const auto part = SplitSubmap(
      thing, [&](const Eigen::Vector3d& p_m) { return p_m.x() > 5 * voxel_m; }, map);
  ASSERT_TRUE(part);
  EXPECT_TRUE(map.Find(*part)->info().T_map_submap.isApprox(T));
}

TEST_F(Split, ClearingTakesWhatLiesWithinAndNothingElse) {
  const auto before = KnownIn(map, {thing});
  const Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-1), Eigen::Vector3d(5 * voxel_m, 1, 1));
  const auto all = [](const SubmapInfo&) { return true; };
  const ClearedRegion cleared = ClearRegion(box, all, map);
  EXPECT_EQ(cleared.num_voxels, 5 * 4 * 4);
  EXPECT_EQ(cleared.changed, std::vector<SubmapId>{thing});
  EXPECT_TRUE(cleared.removed.empty());
  auto expected = before;
  std::erase_if(expected, [](const auto& known) { return known.first.x < 5; });
  EXPECT_EQ(KnownIn(map, {thing}), expected);
}

TEST_F(Split, WhatIsClearedWholeIsGone) {
  const BoundingSphere sphere{Eigen::Vector3d::Zero(), 100.0};
  EXPECT_EQ(ClearRegion(
                sphere, [](const SubmapInfo& info) { return info.class_id == ClassId(3); }, map)
                .num_voxels,
            0);
  const ClearedRegion cleared = ClearRegion(
      sphere, [](const SubmapInfo&) { return true; }, map);
  EXPECT_EQ(cleared.removed, std::vector<SubmapId>{thing});
  EXPECT_EQ(map.Find(thing), nullptr);
}

}  // namespace
}  // namespace dhpmap
