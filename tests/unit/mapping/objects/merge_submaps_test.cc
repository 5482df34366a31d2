// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/merge_submaps.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "mapping/refinement/adopt_refinement.h"
#include "mapping/refinement/refine_map.h"
#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

constexpr ClassId kChair{1}, kTable{2};

MapInfo Info() { return testing::NamedMap("m", 3, 1); }

SubmapId AddThing(Map& map, ClassId class_id = kChair) {
  return map.Create(testing::SettledThingOn(map, class_id)).id();
}

void Observe(Map& map, SubmapId id, BlockIndex block, int linear, float distance_m, float weight,
             const LabelHistograms& seen) {
  Submap& submap = *map.FindMutable(id);
  TsdfBlock& tsdf = submap.MutableTsdf(block);
  tsdf.distance_m[static_cast<std::size_t>(linear)] = distance_m;
  tsdf.weight[static_cast<std::size_t>(linear)] = weight;
  if (!seen.instances.empty()) submap.MutableLabels(block).Set(linear, seen);
  for (const LabelCount& count : seen.classes) {
    submap.AddClassObservations(ClassId(static_cast<std::uint16_t>(count.id)), count.count);
  }
  submap.UpdateBoundingSphere();
}

/// Of all voxels, how often each instance was seen, by the name that everybody has for it.
std::map<std::uint32_t, std::uint64_t> SeenInstances(const Map& map) {
  std::map<std::uint32_t, std::uint64_t> seen;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; entry.labels != nullptr && i < kBlockVoxels; ++i) {
        entry.labels->VisitInstances(
            i, [&](InstanceCount count) { seen[count.id.In(submap->id()).value] += count.count; });
      }
    }
  }
  return seen;
}

TEST(MergeSubmaps, VoxelsOfBothAreAveragedAndCountsAdded) {
  Map map(Info());
  const SubmapId into = AddThing(map), from = AddThing(map);
  Observe(map, into, {0, 0, 0}, 5, 0.01f, 3, {{{1, 3}}, {{kOwnInstance, 3}}});
  Observe(map, from, {0, 0, 0}, 5, 0.05f, 1, {{{1, 1}, {2, 4}}, {{kOwnInstance, 5}}});
  Observe(map, from, {0, 0, 0}, 6, 0.02f, 2, {{{1, 2}}, {{kOwnInstance, 2}}});
  Observe(map, from, {4, 0, 0}, 7, 0.03f, 2, {{{1, 2}}, {{kOwnInstance, 2}}});
  ASSERT_TRUE(CanMerge(map, from, into));
  MergeSubmaps(from, into, map);

  EXPECT_EQ(map.Find(from), nullptr);
  EXPECT_EQ(map.info().merged.Into(from), into);
  const Submap& whole = *map.Find(into);
  const BlockEntry& shared = *whole.blocks().Find({0, 0, 0});
  EXPECT_FLOAT_EQ(shared.tsdf->distance_m[5], 0.02f);
  EXPECT_FLOAT_EQ(shared.tsdf->weight[5], 4);
  EXPECT_EQ(shared.labels->Get(5), (LabelHistograms{{{1, 4}, {2, 4}}, {{kOwnInstance, 8}}}));
  EXPECT_FLOAT_EQ(shared.tsdf->distance_m[6], 0.02f);
  EXPECT_FLOAT_EQ(whole.blocks().Find({4, 0, 0})->tsdf->distance_m[7], 0.03f);
  EXPECT_EQ(whole.info().class_counts, (std::vector<ClassTotal>{{kChair, 8}, {kTable, 4}}));
  const double reach_m = whole.bounding_sphere().center_m.x() + whole.bounding_sphere().radius_m;
  EXPECT_GE(reach_m, 5 * 8 * map.info().config.voxel_size_m);
}

TEST(MergeSubmaps, RowsSpanBothAndTheSurerCounts) {
  Map map(Info());
  const SubmapId into = AddThing(map), from = AddThing(map);
  SubmapInfo& a = map.FindMutable(into)->mutable_info();
  a.num_frames_observed = 5, a.first_observed_ns = 30, a.last_observed_ns = 40, a.is_confirmed = false;
  a.presence = Presence::kAbsent;
  SubmapInfo& b = map.FindMutable(from)->mutable_info();
  b.num_frames_observed = 7, b.first_observed_ns = 10, b.last_observed_ns = 35, b.activity = Activity::kActive;
  b.last_contradicted_ns = 12, b.track_id = 9, b.display_name = "mine";
  MergeSubmaps(from, into, map);
  const SubmapInfo& whole = map.Find(into)->info();
  EXPECT_EQ(whole.num_frames_observed, 12);
  EXPECT_EQ(whole.first_observed_ns, 10);
  EXPECT_EQ(whole.last_observed_ns, 40);
  EXPECT_EQ(whole.last_contradicted_ns, 12);
  EXPECT_TRUE(whole.is_confirmed);
  EXPECT_EQ(whole.activity, Activity::kActive);
  EXPECT_EQ(whole.presence, Presence::kPresent);
  EXPECT_EQ(whole.track_id, 9u);
  EXPECT_EQ(whole.display_name, "mine");
}

TEST(MergeSubmaps, WhatIsLookedThroughGivesWayToWhatIsNot) {
  Map map(Info());
  const SubmapId into = AddThing(map), from = AddThing(map);
  const auto raise = [&](SubmapId id, int linear, int count) {
    map.FindMutable(id)->MutableGone({0, 0, 0}).Set(linear, count);
  };
  for (int linear = 0; linear < 4; ++linear) {
    Observe(map, into, {0, 0, 0}, linear, 0.01f, 1, {{{1, 1}}, {{kOwnInstance, 1}}});
    Observe(map, from, {0, 0, 0}, linear, 0.03f, 1, {{{1, 1}}, {{kOwnInstance, 1}}});
  }
  raise(into, 0, 3);                     // gone here, there there
  raise(from, 1, 3);                     // the other way round
  raise(into, 2, 2), raise(from, 2, 1);  // both doubted
  raise(into, 3, 3), raise(from, 3, 3);  // gone in both
  MergeSubmaps(from, into, map);
  const BlockEntry& block = *map.Find(into)->blocks().Find({0, 0, 0});
  EXPECT_FLOAT_EQ(block.tsdf->distance_m[0], 0.03f);
  EXPECT_FLOAT_EQ(block.tsdf->distance_m[1], 0.01f);
  EXPECT_FLOAT_EQ(block.tsdf->distance_m[2], 0.02f);
  EXPECT_EQ(block.gone->Count(0), 0);
  EXPECT_EQ(block.gone->Count(1), 0);
  EXPECT_EQ(block.gone->Count(2), 1);
  EXPECT_EQ(block.gone->Count(3), 3);
}

TEST(MergeSubmaps, WhatAnySubmapHasSeenOfThePartWasTheWhole) {
  std::mt19937 random(7);
  const auto below = [&random](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
  for (int round = 0; round < 20; ++round) {
    Map map(Info());
    std::vector<SubmapId> ids;
    ids.reserve(5);
    for (int i = 0; i < 5; ++i) ids.push_back(AddThing(map));
    for (int n = 0; n < 300; ++n) {
      const SubmapId holder = ids[below(5)];
      LabelHistograms seen{.classes = {{1, 1 + below(9)}}, .instances = {{kOwnInstance, 1 + below(70'000)}}};
      for (const SubmapId other : ids) {
        if (other != holder && below(3) == 0) seen.instances.push_back({SeenInstance(other), 1 + below(5)});
      }
      const auto at = static_cast<std::int32_t>(below(3));
      Observe(map, holder, {at, 0, 0}, static_cast<int>(below(kBlockVoxels)), 0.01f, 1, seen);
    }
    auto expected = SeenInstances(map);
    const SubmapId from = ids[1 + below(4)], into = ids[0];
    expected[into.value] += expected[from.value];
    expected.erase(from.value);
    const auto before = map.Publish(1);
    MergeSubmaps(from, into, map);
    EXPECT_EQ(SeenInstances(map), expected);
    EXPECT_NE(before->Find(from), nullptr) << "a state that somebody holds stays as it was";
  }
}

TEST(MergeSubmaps, BlocksOfThePartAloneAreSharedAsTheyAre) {
  Map map(Info());
  const SubmapId into = AddThing(map), from = AddThing(map), other = AddThing(map);
  const LabelHistograms own{{{1, 2}}, {{kOwnInstance, 2}}};
  const LabelHistograms both{{{1, 3}}, {{kOwnInstance, 1}, {SeenInstance(other), 2}}};
  Observe(map, into, {0, 0, 0}, 5, 0.01f, 1, own);
  Observe(map, from, {0, 0, 0}, 6, 0.01f, 1, own);
  Observe(map, from, {9, 0, 0}, 7, 0.01f, 1, both);
  map.FindMutable(from)->MutableLabels({9, 0, 0}).SetConcluded(7, true);
  const auto before = map.Publish(1);
  MergeSubmaps(from, into, map);
  const BlockEntry& was = *before->Find(from)->blocks().Find({9, 0, 0});
  const BlockEntry& is = *map.Find(into)->blocks().Find({9, 0, 0});
  EXPECT_EQ(is.tsdf, was.tsdf);
  EXPECT_EQ(is.labels, was.labels);
  EXPECT_NE(map.Find(into)->blocks().Find({0, 0, 0})->labels, before->Find(from)->blocks().Find({0, 0, 0})->labels);

  map.FindMutable(into)->MutableLabels({9, 0, 0}).Set(8, own);  // shared: copied before it is written to
  EXPECT_TRUE(was.labels->IsEmpty(8));
}

TEST(MergeSubmaps, OfBlocksOfThePartAloneWhatWasTheWholesBecomesItsOwn) {
  Map map(Info());
  const SubmapId into = AddThing(map), from = AddThing(map);
  const LabelHistograms taken{{{1, 5}}, {{kOwnInstance, 1}, {SeenInstance(into), 4}}};
  const BlockIndex here{4, 0, 0}, there{5, 0, 0};
  Observe(map, from, here, 1, 0.01f, 1, taken);
  map.FindMutable(from)->MutableLabels(here).SetConcluded(1, true);
  Observe(map, from, there, 2, 0.01f, 1, {{{1, 2}}, {{kOwnInstance, 2}}});
  map.FindMutable(from)->MutableLabels(there).SetConcluded(2, true);  // although it has seen nothing else
  map.FindMutable(from)->MutableLabels(there).SetConcluded(3, true);  // nor anything at all
  MergeSubmaps(from, into, map);
  const Submap& whole = *map.Find(into);
  EXPECT_EQ(whole.blocks().Find(here)->labels->Get(1), (LabelHistograms{{{1, 5}}, {{kOwnInstance, 5}}}));
  EXPECT_FALSE(whole.blocks().Find(here)->labels->IsConcluded(1)) << "it is seen as what holds it";
  EXPECT_TRUE(HasNone(whole.blocks().Find(there)->labels->concluded()));
  EXPECT_EQ(whole.info().class_counts, (std::vector<ClassTotal>{{kChair, 7}}));
}

TEST(MergeSubmaps, ChainsAreResolvedAndPairsFollow) {
  Map map(Info());
  const SubmapId a = AddThing(map), b = AddThing(map), c = AddThing(map), d = AddThing(map);
  ObjectPairs& pairs = map.mutable_info().pairs;
  pairs.AddEvidence(b, c, 30, -120, 60);
  pairs.AddEvidence(c, d, 20, -120, 60);
  pairs.AddEvidence(b, d, 5, -120, 60);
  pairs.SetVerdict(a, c, PairVerdict::kMustBeTwo);
  MergeSubmaps(c, b, map);
  EXPECT_EQ(map.info().pairs.Of(b, d).evidence, 25);
  EXPECT_EQ(map.info().pairs.Of(a, b).verdict, PairVerdict::kMustBeTwo);
  EXPECT_EQ(map.info().pairs.pairs().size(), 2u);
  MergeSubmaps(b, a, map);
  EXPECT_EQ(map.info().merged.Into(b), a);
  EXPECT_EQ(map.info().merged.Into(c), a);
  EXPECT_FALSE(map.info().merged.Into(a));
  EXPECT_TRUE(map.Remove(d));
  EXPECT_TRUE(map.info().pairs.pairs().empty());
}

TEST(MergeForGood, IsNotedAsLongAsTheWholeIsThereWhateverItIsMergedInto) {
  Map map(Info());
  const SubmapId a = AddThing(map), b = AddThing(map), c = AddThing(map);
  for (const SubmapId id : {a, b, c}) map.FindMutable(id)->mutable_info().is_confirmed = false;
  MergeSubmaps(c, b, map);
  EXPECT_NE(map.info().pairs.Of(b, c).verdict, PairVerdict::kMustBeOne) << "frames alone have said so";
  EXPECT_FALSE(map.Find(b)->info().is_confirmed);

  MergeForGood(b, a, map);
  EXPECT_EQ(map.info().pairs.Of(a, b).verdict, PairVerdict::kMustBeOne);
  EXPECT_EQ(map.info().merged.Into(c), a);
  EXPECT_TRUE(map.Find(a)->info().is_confirmed) << "not to be dissolved";
  const SubmapId d = AddThing(map);
  MergeSubmaps(a, d, map);
  EXPECT_EQ(map.info().pairs.Of(b, d).verdict, PairVerdict::kMustBeOne);
  EXPECT_EQ(map.info().merged.Into(b), d);
  EXPECT_TRUE(map.Remove(d));
  EXPECT_TRUE(map.info().pairs.pairs().empty());
}

TEST(MergeSubmaps, OnlyThingsOnOneGridCanBeMerged) {
  Map map(Info());
  const SubmapId a = AddThing(map), b = AddThing(map), moved = AddThing(map), wall = AddThing(map);
  map.FindMutable(moved)->mutable_info().T_map_submap.translation().x() = 1;
  map.FindMutable(wall)->mutable_info().panoptic = Panoptic::kStuff;
  EXPECT_TRUE(CanMerge(map, b, a));
  EXPECT_FALSE(CanMerge(map, a, a));
  EXPECT_FALSE(CanMerge(map, moved, a));
  EXPECT_FALSE(CanMerge(map, wall, a));
  EXPECT_FALSE(CanMerge(map, a, kUnknownSubmap));
  EXPECT_FALSE(CanMerge(map, SubmapId(99), a));
}

TEST(MergeSubmaps, RefinementUnderWayLosesNoCount) {
  Map map(Info());
  const SubmapId a = AddThing(map), b = AddThing(map), other = AddThing(map, kTable);
  for (int linear = 0; linear < 64; ++linear) {
    Observe(map, a, {0, 0, 0}, linear, 0.01f, 1, {{{1, 3}}, {{kOwnInstance, 3}}});
    Observe(map, b, {0, 0, 0}, linear, 0.01f, 1, {{{1, 5}}, {{kOwnInstance, 5}}});
    Observe(map, other, {0, 0, 0}, linear, 0.01f, 1, {{{2, 2}}, {{kOwnInstance, 2}}});
    Observe(map, other, {9, 0, 0}, linear, 0.01f, 1, {{{2, 2}}, {{kOwnInstance, 2}, {SeenInstance(b), 1}}});
  }
  auto expected = SeenInstances(map);
  expected[a.value] += expected[b.value];
  expected.erase(b.value);

  const auto state = map.Freeze();
  ThreadPool pool(1);
  Map refined(state);
  RefineMap(refined, pool);
  const RefinementOutcome outcome = OutcomeOf(std::make_shared<const StateMarks>(*state), *refined.Freeze());
  MergeSubmaps(b, a, map);
  EXPECT_GT(AdoptRefinement(outcome, map), 0);
  EXPECT_EQ(SeenInstances(map), expected);
  EXPECT_EQ(map.Find(b), nullptr);
}

}  // namespace
}  // namespace dhpmap
