// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/point_lookup.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

constexpr ClassId kThing{1}, kStuff{2};

MapInfo Info() { return testing::NamedMap("m", 1, 1); }

Submap& AddSubmap(Map& map, Panoptic panoptic, ClassId class_id) {
  return map.Create(testing::InfoOn(map, panoptic, class_id));
}

void Observe(Submap& submap, VoxelIndex v, float distance_m, float weight, int num_observations, ClassId c) {
  const int i = LinearIndex(v);
  TsdfBlock& tsdf = submap.MutableTsdf(BlockOf(v));
  tsdf.distance_m[static_cast<std::size_t>(i)] = distance_m;
  tsdf.weight[static_cast<std::size_t>(i)] = weight;
  for (int n = 0; n < num_observations; ++n) submap.MutableLabels(BlockOf(v)).AddObservation(i, c);
  submap.UpdateBoundingSphere();
}

TEST(PointLookup, EmptyMapKnowsNothing) {
  Map map(Info());
  EXPECT_FALSE(PointLookup(map.Publish(0)).At({0, 0, 0}).is_observed);
}

TEST(PointLookup, WhatWasLookedThroughIsFreeUnlessASurfaceIsNear) {
  Map map(Info());
  FreeBlocks seen;
  seen.full = 1;  // the block at the origin
  map.mutable_free_space().Add({0, 0, 0}, seen, 0);
  Observe(AddSubmap(map, Panoptic::kThing, kThing), {1, 0, 0}, 0.03f, 1.0f, 1, kThing);
  Observe(AddSubmap(map, Panoptic::kThing, kThing), {2, 0, 0}, 0.08f, 1.0f, 1, kThing);  // at the truncation
  Observe(AddSubmap(map, Panoptic::kThing, kThing), {3, 0, 0}, 0.08f, 9.0f, 9, kThing);
  Observe(AddSubmap(map, Panoptic::kThing, kThing), {3, 0, 0}, -0.05f, 1.0f, 1, kThing);
  const PointLookup lookup(map.Publish(0));
  const auto at = [&](int x) { return lookup.At(VoxelCentre({x, 0, 0}, 0.04)); };
  EXPECT_TRUE(at(0).is_free);
  EXPECT_FALSE(at(0).is_observed);
  EXPECT_FALSE(at(1).is_free);
  EXPECT_TRUE(at(2).is_free && at(2).is_observed);
  EXPECT_FALSE(at(3).is_free) << "whichever submap answers";
  EXPECT_FALSE(at(8).is_free) << "another block: unknown";
  EXPECT_FALSE(at(-1).is_free);
  EXPECT_FALSE(lookup.At({1e300, 0, 0}).is_free);
  EXPECT_FALSE(lookup.At({0, -1e12, 0}).is_free);
}

TEST(PointLookup, MostObservedSubmapAnswersWhereSurfacesAreEquallyNear) {
  Map map(Info());
  Submap& thing = AddSubmap(map, Panoptic::kThing, kThing);
  Observe(thing, {3, 4, -5}, 0.01f, 2.0f, 3, kThing);
  Submap& stuff = AddSubmap(map, Panoptic::kStuff, kStuff);
  Observe(stuff, {3, 4, -5}, 0.01f, 9.0f, 1, kStuff);
  const PointInfo info = PointLookup(map.Publish(0)).At(VoxelCentre({3, 4, -5}, 0.04));
  ASSERT_TRUE(info.is_observed);
  EXPECT_EQ(info.submap, SubmapId(1));
  EXPECT_EQ(info.class_id, kThing);
  EXPECT_FLOAT_EQ(info.weight, 2.0f);
  EXPECT_FLOAT_EQ(info.instance_confidence, 0.75f);
}

TEST(PointLookup, NearerSurfaceWinsOverMoreObservations) {
  Map map(Info());
  Observe(AddSubmap(map, Panoptic::kThing, kThing), {0, 0, 0}, 0.0f, 1.0f, 2, kThing);
  Observe(AddSubmap(map, Panoptic::kStuff, kStuff), {0, 0, 0}, 0.07f, 9.0f, 6, kStuff);
  EXPECT_EQ(PointLookup(map.Publish(0)).At({0.01, 0.01, 0.01}).class_id, kThing);
}

TEST(PointLookup, UnknownSubmapAnswersOnlyWhereNobodyElseDoes) {
  Map map(Info());
  Observe(*map.FindMutable(kUnknownSubmap), {0, 0, 0}, 0.0f, 50.0f, 0, kThing);
  Observe(*map.FindMutable(kUnknownSubmap), {1, 0, 0}, 0.0f, 50.0f, 0, kThing);
  Observe(AddSubmap(map, Panoptic::kThing, kThing), {0, 0, 0}, 0.0f, 1.0f, 1, kThing);
  const PointLookup lookup(map.Publish(0));
  EXPECT_EQ(lookup.At({0.01, 0.01, 0.01}).submap, SubmapId(1));
  const PointInfo unknown = lookup.At({0.05, 0.01, 0.01});
  EXPECT_TRUE(unknown.is_observed);
  EXPECT_EQ(unknown.submap, kUnknownSubmap);
  EXPECT_EQ(unknown.panoptic, Panoptic::kUnknown);
}

TEST(PointLookup, DroppedLabelsAnswerWithTheSubmapsLabel) {
  Map map(Info());
  Submap& thing = AddSubmap(map, Panoptic::kThing, kThing);
  Observe(thing, {0, 0, 0}, 0.0f, 1.0f, 4, kThing);
  thing.AddClassObservations(kThing, 4);
  thing.DropLabels();
  const PointInfo info = PointLookup(map.Publish(0)).At({0.01, 0.01, 0.01});
  EXPECT_EQ(info.submap, SubmapId(1));
  EXPECT_EQ(info.class_id, kThing);
  EXPECT_FLOAT_EQ(info.class_confidence, 1.0f);
}

TEST(PointLookup, MovedSubmapAnswersAtItsNewPlaceOnly) {
  Map map(Info());
  Submap& thing = AddSubmap(map, Panoptic::kThing, kThing);
  Observe(thing, {2, 0, 0}, 0.0f, 1.0f, 1, kThing);
  Transform& T = thing.mutable_info().T_map_submap;
  T.translation() = Eigen::Vector3d(5, -1, 2);
  T.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d moved = T * VoxelCentre({2, 0, 0}, 0.04);
  const PointLookup lookup(map.Publish(0));
  EXPECT_EQ(lookup.At(moved).submap, SubmapId(1));
  EXPECT_FALSE(lookup.At(VoxelCentre({2, 0, 0}, 0.04)).is_observed);
}

TEST(PointLookup, AnswersAlongATrailOfStatesAsFromNothing) {
  // Things are moved, seen more of, cloned and removed; the index of each state is made from that of another.
  Map map(Info());
  std::mt19937 random(4);
  std::uniform_int_distribution<int> voxel(-40, 40);
  for (int i = 0; i < 30; ++i) {
    Submap& submap = AddSubmap(map, Panoptic::kThing, kThing);
    for (int n = 0; n < 20; ++n) {
      Observe(submap, {voxel(random), voxel(random), voxel(random) / 8}, 0.01f * static_cast<float>(n), 1, 1, kThing);
    }
  }
  IndexTrail trail;
  std::uniform_real_distribution<double> unit(-2, 2);
  std::vector<std::shared_ptr<const MapSnapshot>> states;
  std::size_t num_continued = 0;
  const auto expect_equals_fresh = [&](const std::shared_ptr<const MapSnapshot>& state) {
    const PointLookup along(state, trail), fresh(state);
    num_continued += along.index().num_replaced() > 0;
    int num_observed = 0;
    for (int n = 0; n < 3000; ++n) {
      const Eigen::Vector3d p{unit(random), unit(random), unit(random) / 8};
      const PointInfo a = along.At(p), b = fresh.At(p);
      num_observed += b.is_observed;
      EXPECT_EQ(a.is_observed, b.is_observed);
      EXPECT_EQ(a.submap, b.submap);
      EXPECT_EQ(a.distance_m, b.distance_m);
      EXPECT_EQ(a.instance_confidence, b.instance_confidence);
    }
    EXPECT_GT(num_observed, 0);
  };
  for (std::uint32_t step = 0; step < 24; ++step) {
    const SubmapId id(1 + step % 20);
    switch (step % 6) {
      case 4: map.Clone(id)->mutable_info().T_map_submap.translation().x() += 0.4; break;
      case 5: EXPECT_TRUE(map.Remove(map.submaps().back()->id())); break;
      case 1: Observe(*map.FindMutable(id), {60, voxel(random), 0}, 0, 1, 1, kThing); break;
      default: map.FindMutable(id)->mutable_info().T_map_submap.translation().y() += 0.04 * (1 + step);
    }
    states.push_back(map.Publish(step));
    expect_equals_fresh(states.back());
    if (step % 8 == 7) expect_equals_fresh(states[step / 2]);  // of an older one that somebody holds
    if (step % 5 == 4) states[step - 1] = states[step];        // another goes
  }
  EXPECT_GT(num_continued, 10u) << "the index was continued, not made anew";
}

TEST(PointLookup, FindsEveryObservedVoxelOfManySubmaps) {
  Map map(Info());
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(-40, 40);
  std::vector<std::pair<SubmapId, VoxelIndex>> truth;
  for (int s = 0; s < 30; ++s) {
    Submap& submap = AddSubmap(map, Panoptic::kThing, kThing);
    // Each submap has a layer of voxels of its own.
    for (int n = 0; n < 20; ++n) {
      const VoxelIndex v{coordinate(random), coordinate(random), s};
      Observe(submap, v, 0.0f, 1.0f, 1, kThing);
      truth.emplace_back(submap.id(), v);
    }
  }
  const PointLookup lookup(map.Publish(0));
  for (const auto& [id, voxel] : truth) EXPECT_EQ(lookup.At(VoxelCentre(voxel, 0.04)).submap, id);
}

}  // namespace
}  // namespace dhpmap
