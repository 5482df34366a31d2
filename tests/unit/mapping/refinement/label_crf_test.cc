// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_crf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "mapping/evidence/label_management.h"
#include "mapping/evidence/submap_labels.h"
#include "mapping/evidence/voxel_handover.h"
#include "mapping/refinement/crf_tiles.h"
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

class ManagedMaps : public ::testing::TestWithParam<unsigned> {
 protected:
  ManagedMaps() { ManageLabels(AllIds(map_), map_, pool_); }
  ThreadPool pool_{2};
  Map map_ = RandomMap(GetParam());
};

TEST_P(ManagedMaps, StayExclusiveAndKeepAllObservationsAndAllWeight) {
  const Totals before = Sum(map_);
  const LabelCrfReport report = RefineLabels(AllIds(map_), map_, pool_);
  EXPECT_GT(report.num_changed_instances, 0);
  EXPECT_EQ(Sum(map_), before);
  std::set<VoxelIndex> held;
  ForEachVoxel(map_, [&](const Submap&, const BlockEntry& entry, int i) {
    EXPECT_TRUE(held.insert(VoxelIn(entry.index, i)).second) << "held twice";
  });
}

TEST_P(ManagedMaps, LeaveNothingForLabelManagementAfterwards) {
  RefineLabels(AllIds(map_), map_, pool_);
  const auto refined = map_.Publish(0);
  ManageLabels(AllIds(map_), map_, pool_);
  EXPECT_EQ(map_.Publish(0), refined);
}

TEST_P(ManagedMaps, HaveTheTotalsOfTheirVoxels) {
  for (const SubmapId id : AllIds(map_)) RecomputeSubmapLabels(*map_.FindMutable(id));
  EXPECT_GT(RefineLabels(AllIds(map_), map_, pool_).num_changed_instances, 0);
  Map counted(map_.Freeze());
  for (const SubmapId id : AllIds(counted)) RecomputeSubmapLabels(*counted.FindMutable(id));
  for (const auto& submap : map_.submaps()) {
    EXPECT_EQ(submap->info().class_counts, counted.Find(submap->id())->info().class_counts);
  }
}

TEST_P(ManagedMaps, AreRefinedTheSameByAnyNumberOfThreads) {
  Map other(map_.Freeze());
  ThreadPool single(1);
  RefineLabels(AllIds(map_), map_, pool_);
  RefineLabels(AllIds(other), other, single);
  EXPECT_TRUE(testing::MapsAreEqual(*map_.Freeze(), *other.Freeze()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, ManagedMaps, ::testing::Range(0u, 6u));

constexpr Color kRed{200, 60, 40}, kGrey{60, 80, 90};

void Paint(Submap& submap, VoxelIndex v, Color color) {
  submap.MutableTsdf(BlockOf(v)).color[static_cast<std::size_t>(LinearIndex(v))] = color;
}

/// A slab of two submaps, 1 (class 1) at x < 0 and 2 (class 2) beyond, in which a share of the voxels has seen the
/// other one more often. `colors`: the two halves look different.
Map Slab(double flipped_share, bool colors) {
  constexpr int kHalf_vox = 24;
  Map map(testing::RandomMapInfo());
  for (int s = 0; s < 2; ++s) AddSubmap(map).mutable_info().class_id = ClassId(static_cast<std::uint16_t>(s + 1));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> chance(0, 1);
  for (int x = -kHalf_vox; x < kHalf_vox; ++x) {
    for (int y = 0; y < kHalf_vox; ++y) {
      for (int z = -2; z < 2; ++z) {
        const std::uint32_t right = x < 0 ? 1 : 2;
        const std::uint32_t seen = chance(random) < flipped_share ? 3 - right : right;
        Submap& submap = *map.FindMutable(SubmapId(seen));
        Put(submap, {x, y, z}, 0.01f * static_cast<float>(z), 1.0f, {{{seen, 5}}, {{kOwnInstance, 5}}});
        Paint(submap, {x, y, z}, colors && x < 0 ? kRed : kGrey);
      }
    }
  }
  return map;
}

/// Share of the voxels, `margin_vox` from the border at least, that lie in the submap they should.
double RightShare(const Map& map, int margin_vox) {
  double right = 0, all = 0;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    const VoxelIndex v = VoxelIn(entry.index, i);
    if (v.x >= -margin_vox && v.x < margin_vox) return;
    all += 1;
    right += submap.id() == SubmapId(v.x < 0 ? 1 : 2);
  });
  return right / all;
}

TEST(RefineLabels, RestoresASlabInWhichAFifthOfTheVoxelsIsWrong) {
  Map map = Slab(0.2, false);
  ThreadPool pool(2);
  RefineLabels(AllIds(map), map, pool);
  EXPECT_GT(RightShare(map, 3), 0.99);
}

TEST(RefineLabels, DoesNotBleedAcrossAnEdgeOfColour) {
  Map map = Slab(0.2, true);
  ThreadPool pool(2);
  RefineLabels(AllIds(map), map, pool);
  EXPECT_GT(RightShare(map, 0), 0.99);
}

TEST(RefineLabels, WhatMovesTakesAllItHasSeenAlongAndIsMarked) {
  Map map = Slab(0.2, true);
  ThreadPool pool(2);
  const LabelCrfReport report = RefineLabels(AllIds(map), map, pool);
  EXPECT_GT(report.num_changed_instances, 0.19 * 48 * 24 * 4);
  EXPECT_EQ(report.num_changed_classes, report.num_changed_instances);
  std::int64_t num_concluded = 0;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    const LabelHistograms seen = entry.labels->Get(i);
    ASSERT_EQ(seen.classes.size(), 1u);
    EXPECT_EQ(seen.classes[0].count, 5u);
    const std::uint32_t instance = seen.classes[0].id;  // as Slab has it
    const auto by_holder = SeenInstance::Of(SubmapId(instance), submap.id());
    EXPECT_EQ(seen.instances, (std::vector<InstanceCount>{{by_holder, 5}}));
    EXPECT_EQ(entry.labels->IsConcluded(i), !by_holder.IsOwn());
    num_concluded += !by_holder.IsOwn();
  });
  EXPECT_EQ(num_concluded, report.num_changed_instances);
}

TEST(RefineLabels, WhatWasConcludedIsNoVoteForAClass) {
  Map map = Slab(0.2, true);
  ThreadPool pool(1);
  RefineLabels(AllIds(map), map, pool);
  for (const SubmapId id : AllIds(map)) {
    if (id == kUnknownSubmap) continue;
    const SubmapInfo& info = map.Find(id)->info();
    ASSERT_EQ(info.class_counts.size(), 1u);
    EXPECT_EQ(info.class_counts[0].id.value, id.value);
    EXPECT_LT(info.instance_confidence, 0.9f)
        << "what it holds against what was seen says something of it all the same";
  }
}

TEST(RefineLabels, WhatWasConcludedCanBeThrownAwayAndMadeAgain) {
  Map map = Slab(0.2, true);
  ThreadPool pool(2);
  for (const SubmapId id : AllIds(map)) RecomputeSubmapLabels(*map.FindMutable(id));
  for (const SubmapId id : AllIds(map)) map.FindMutable(id)->UpdateBoundingSphere();
  const auto seen = map.Freeze();
  const std::int64_t num_moved = RefineLabels(AllIds(map), map, pool).num_changed_instances;
  const auto refined = map.Freeze();
  EXPECT_EQ(ForgetConclusions(AllIds(map), map, pool), num_moved);
  EXPECT_TRUE(testing::MapsAreEqual(*map.Freeze(), *seen));
  RefineLabels(AllIds(map), map, pool);
  EXPECT_TRUE(testing::MapsAreEqual(*map.Freeze(), *refined));
}

/// Who holds each voxel, and what it has seen.
std::map<VoxelIndex, std::pair<SubmapId, LabelHistograms>> HeldAndSeen(const Map& map) {
  std::map<VoxelIndex, std::pair<SubmapId, LabelHistograms>> voxels;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    voxels[VoxelIn(entry.index, i)] = {submap.id(), entry.labels->Get(i)};
  });
  return voxels;
}

/// Sees every third voxel of the slab some more times, as one of the two submaps at random.
void SeeMore(unsigned seed, Map& map) {
  std::mt19937 random(seed);
  for (int x = -24; x < 24; ++x) {
    for (int y = 0; y < 24; y += 3) {
      const std::uint32_t seen = 1 + random() % 2;
      Submap& submap = *map.FindMutable(SubmapId(seen));
      Put(submap, {x, y, 0}, 0.0f, 1.0f, {{{seen, 4}}, {{kOwnInstance, 4}}});
      Paint(submap, {x, y, 0}, kGrey);
    }
  }
}

TEST(RefineLabels, WhatAnEarlierRunHasConcludedHasNoSay) {
  Map often = Slab(0.3, false), once = Slab(0.3, false);
  ThreadPool pool(1);
  for (unsigned turn = 0; turn < 3; ++turn) {
    RefineLabels(AllIds(often), often, pool);
    SeeMore(turn, often);
    ManageLabels(AllIds(often), often, pool);
    SeeMore(turn, once);
    ManageLabels(AllIds(once), once, pool);
  }
  RefineLabels(AllIds(often), often, pool);
  RefineLabels(AllIds(once), once, pool);
  EXPECT_EQ(HeldAndSeen(often), HeldAndSeen(once));
}

TEST(RefineLabels, ALeadOfManySightingsHoldsWhereTheSameShareOfFewDoesNot) {
  const VoxelIndex few{-12, 12, 0}, many{-12, 12, 1};
  Map map = Slab(0.0, false);
  ThreadPool pool(1);
  for (const auto& [v, times] : {std::pair{few, 1u}, std::pair{many, 100u}}) {
    map.FindMutable(SubmapId(1))->MutableTsdf(BlockOf(v)).weight[static_cast<std::size_t>(LinearIndex(v))] = 0;
    map.FindMutable(SubmapId(1))->MutableLabels(BlockOf(v)).Clear(LinearIndex(v));
    Put(*map.FindMutable(SubmapId(2)), v, 0.0f, 1.0f,
        {{{2, 4 * times}}, {{kOwnInstance, 4 * times}, {SeenInstance(SubmapId(1)), times}}});
    Paint(*map.FindMutable(SubmapId(2)), v, kGrey);
  }
  RefineLabels(AllIds(map), map, pool);
  EXPECT_EQ(HeldAndSeen(map)[few].first, SubmapId(1));
  EXPECT_EQ(HeldAndSeen(map)[many].first, SubmapId(2));
}

TEST(RefineLabels, ACrowdElsewhereInTheTileChangesNothing) {
  Map map = Slab(0.2, false), crowded = Slab(0.2, false);
  for (std::uint32_t i = 0; i < 30; ++i) {  // in one block, so that each needs a channel of its own
    Submap& submap = AddSubmap(crowded);
    Put(submap, {-20, 4, 50 + static_cast<int>(i % 6)}, 0.0f, 1.0f, {{{1, 1}}, {{kOwnInstance, 1}}});
  }
  ThreadPool pool(2);
  RefineLabels(AllIds(map), map, pool);
  RefineLabels(AllIds(crowded), crowded, pool);
  std::set<std::pair<VoxelIndex, SubmapId>> alone, beside;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    alone.emplace(VoxelIn(entry.index, i), submap.id());
  });
  ForEachVoxel(crowded, [&](const Submap& submap, const BlockEntry& entry, int i) {
    if (entry.index.z < 6) beside.emplace(VoxelIn(entry.index, i), submap.id());
  });
  EXPECT_EQ(alone, beside);
}

TEST(RefineLabels, DoesNotTouchSubmapsThatAreNotNamed) {
  Map map = Slab(0.2, false);
  const auto before = map.Publish(0);
  ThreadPool pool(1);
  RefineLabels(std::vector<SubmapId>{}, map, pool);
  EXPECT_EQ(map.Publish(0), before);
}

TEST(RefineLabels, ACancelledRunEnds) {
  Map map = Slab(0.2, false);
  ThreadPool pool(1);
  EXPECT_EQ(RefineLabels(AllIds(map), map, pool, nullptr, [] { return true; }).num_voxels, 0);
}

/// Those of a list that nothing was seen more often than.
std::vector<SubmapId> Foremost(const std::vector<SubmapCount>& counts) {
  std::uint32_t most = 0;
  for (const SubmapCount& seen : counts) most = std::max(most, seen.count);
  std::vector<SubmapId> ids;
  for (const SubmapCount& seen : counts) {
    if (seen.count == most) ids.push_back(seen.id);
  }
  return ids;
}

/// What all voxels within `rim` blocks have seen most of the submaps there are, ties included: the obvious way.
std::set<std::uint32_t> ChoicesAround(const Map& map, std::span<const HeldBlock> blocks, BlockIndex at, int rim) {
  std::set<std::uint32_t> choices;
  for (const HeldBlock& block : blocks) {
    const int distance =
        std::max({std::abs(block.index.x - at.x), std::abs(block.index.y - at.y), std::abs(block.index.z - at.z)});
    for (int i = 0; i < kBlockVoxels && distance <= rim; ++i) {
      if (!block.entry->tsdf->IsObserved(i) || block.entry->labels->IsEmpty(i)) continue;
      std::vector<SubmapCount> seen;
      for (const InstanceCount& count : block.entry->labels->Get(i).instances) {
        const SubmapId instance = count.id.In(block.holder);
        if (map.Find(instance) != nullptr) seen.push_back({instance, count.count});
      }
      for (const SubmapId id : Foremost(seen)) choices.insert(id.value);
      if (seen.empty()) choices.insert(block.holder.value);
    }
  }
  return choices;
}

TEST_P(ManagedMaps, AreCutIntoTilesOfJustTheBlocksInDisputeAndWhatIsAround) {
  const auto blocks = CollectBlocks(AllIds(map_), map_);
  std::vector<int> inside(blocks.size(), 0);
  for (const CrfTile& tile : CutTiles(blocks, KnownInstances(AllIds(map_), map_), 2, 1, pool_)) {
    for (const std::uint32_t b : tile.inner) ++inside[b];
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
      const bool is_near = std::any_of(tile.inner.begin(), tile.inner.end(), [&](std::uint32_t inner) {
        const BlockIndex i = blocks[inner].index, j = blocks[b].index;
        return std::abs(i.x - j.x) <= 1 && std::abs(i.y - j.y) <= 1 && std::abs(i.z - j.z) <= 1;
      });
      const bool is_member = std::binary_search(tile.inner.begin(), tile.inner.end(), b) ||
                             std::binary_search(tile.rim.begin(), tile.rim.end(), b);
      EXPECT_EQ(is_member, is_near);
    }
  }
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    EXPECT_EQ(inside[b], ChoicesAround(map_, blocks, blocks[b].index, 1).size() > 1 ? 1 : 0);
  }
}

TEST(CutTiles, ATieIsADispute) {
  Map map = Slab(0.0, false);
  const VoxelIndex far{-20, 12, 0};
  LabelBlock& labels = map.FindMutable(SubmapId(1))->MutableLabels(BlockOf(far));
  ThreadPool pool(1);
  const auto is_solved = [&] {
    const auto blocks = CollectBlocks(AllIds(map), map);
    for (const CrfTile& tile : CutTiles(blocks, KnownInstances(AllIds(map), map), 1, 1, pool)) {
      for (const std::uint32_t b : tile.inner) {
        if (blocks[b].index == BlockOf(far)) return true;
      }
    }
    return false;
  };
  labels.Set(LinearIndex(far), {{{1, 9}}, {{kOwnInstance, 5}, {SeenInstance(SubmapId(2)), 4}}});
  EXPECT_FALSE(is_solved());
  labels.Set(LinearIndex(far), {{{1, 10}}, {{kOwnInstance, 5}, {SeenInstance(SubmapId(2)), 5}}});
  EXPECT_TRUE(is_solved());
}

TEST(RefineLabels, WhatIsFarFromAnySurfaceStaysWithWhatItHasSeen) {
  const VoxelIndex near{-12, 12, 0}, far{-12, 12, 1};
  Map map = Slab(0.0, false);
  const auto voxel_size_m = static_cast<float>(map.info().config.voxel_size_m);
  ThreadPool pool(1);
  for (const auto& [v, distance_m] : {std::pair{near, 1.9f * voxel_size_m}, std::pair{far, 2.1f * voxel_size_m}}) {
    map.FindMutable(SubmapId(1))->MutableTsdf(BlockOf(v)).weight[static_cast<std::size_t>(LinearIndex(v))] = 0;
    map.FindMutable(SubmapId(1))->MutableLabels(BlockOf(v)).Clear(LinearIndex(v));
    Put(*map.FindMutable(SubmapId(2)), v, distance_m, 1.0f, {{{2, 1}}, {{kOwnInstance, 1}}});
    Paint(*map.FindMutable(SubmapId(2)), v, kGrey);
  }
  RefineLabels(AllIds(map), map, pool);
  EXPECT_EQ(HeldAndSeen(map)[near].first, SubmapId(1));
  EXPECT_EQ(HeldAndSeen(map)[far].first, SubmapId(2));
}

TEST(CutTiles, WhatWasConcludedIsInDispute) {
  Map map = Slab(0.0, false);
  const VoxelIndex far{-20, 12, 0};
  map.FindMutable(SubmapId(1))->MutableLabels(BlockOf(far)).SetConcluded(LinearIndex(far), true);
  ThreadPool pool(1);
  RefineLabels(AllIds(map), map, pool);
  EXPECT_FALSE(map.Find(SubmapId(1))->blocks().Find(BlockOf(far))->labels->IsConcluded(LinearIndex(far)));
}

TEST(CutTiles, LeavesOutWhatNobodyDisputes) {
  Map map = Slab(0.0, false);
  ThreadPool pool(1);
  const auto blocks = CollectBlocks(AllIds(map), map);
  std::size_t num_inner = 0;
  for (const CrfTile& tile : CutTiles(blocks, KnownInstances(AllIds(map), map), 1, 1, pool)) {
    num_inner += tile.inner.size();
    for (const std::uint32_t b : tile.inner) {
      EXPECT_GE(blocks[b].index.x, -1) << "far from the border";
      EXPECT_LE(blocks[b].index.x, 0);
    }
  }
  EXPECT_GT(num_inner, 0u);
}

TEST(CutTiles, TheLargestComesFirst) {
  Map map = RandomMap(3);
  ThreadPool pool(1);
  const auto blocks = CollectBlocks(AllIds(map), map);
  std::vector<std::size_t> sizes;
  for (const CrfTile& tile : CutTiles(blocks, KnownInstances(AllIds(map), map), 1, 1, pool)) {
    sizes.push_back(tile.inner.size() + tile.rim.size());
  }
  ASSERT_FALSE(sizes.empty());
  EXPECT_TRUE(std::ranges::is_sorted(sizes, std::ranges::greater()));
  EXPECT_GT(sizes.front(), sizes.back()) << "else any order would do; in that of their places a small one is first";
}

}  // namespace
}  // namespace dhpmap
