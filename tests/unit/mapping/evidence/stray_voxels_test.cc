// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/stray_voxels.h"

#include <gtest/gtest.h>

#include <set>

#include "mapping/evidence/label_management.h"
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

const LabelHistograms kSeenFiveTimes{{{1, 5}}, {{kOwnInstance, 5}}};

/// A cube of 8^3 voxels of thing 1 at the origin, a wall (submap 2) of voxels at x = 20.
Map CubeAndWall() {
  Map map(testing::RandomMapInfo());
  Submap& cube = AddSubmap(map);
  for (int i = 0; i < kBlockVoxels; ++i) Put(cube, VoxelIn({0, 0, 0}, i), 0.01f, 1.0f, kSeenFiveTimes);
  Submap& wall = AddSubmap(map, Panoptic::kStuff);
  for (int y = 0; y < 8; ++y) {
    for (int z = 0; z < 8; ++z) {
      if (y != 4 || z != 4) Put(wall, {20, y, z}, 0.01f, 1.0f, kSeenFiveTimes);
    }
  }
  return map;
}

bool Holds(const Map& map, std::uint32_t id, VoxelIndex v) {
  const BlockEntry* entry = map.Find(SubmapId(id))->blocks().Find(BlockOf(v));
  return entry != nullptr && entry->tsdf->IsObserved(LinearIndex(v));
}

TEST(AbsorbStrayVoxels, GivesAnIslandOnTheWallToTheWall) {
  Map map = CubeAndWall();
  Put(*map.FindMutable(SubmapId(1)), {20, 4, 4}, 0.01f, 1.0f, kSeenFiveTimes);
  map.FindMutable(SubmapId(1))->UpdateBoundingSphere();
  const auto sum = Sum(map);
  ThreadPool pool(2);
  EXPECT_EQ(AbsorbStrayVoxels(AllIds(map), map, pool), 1);
  EXPECT_FALSE(Holds(map, 1, {20, 4, 4}));
  EXPECT_TRUE(Holds(map, 2, {20, 4, 4}));
  EXPECT_EQ(Sum(map).weight, sum.weight);
  EXPECT_EQ(Sum(map).classes, sum.classes);
  EXPECT_EQ(map.Find(SubmapId(1))->blocks().size(), 1u) << "its sphere is that of the cube";
  EXPECT_EQ(AbsorbStrayVoxels(AllIds(map), map, pool), 0) << "a second time";
}

TEST(AbsorbStrayVoxels, LeavesWhatTouchesTheObjectByACorner) {
  Map map = CubeAndWall();
  Put(*map.FindMutable(SubmapId(1)), {8, 8, 8}, 0.01f, 1.0f, kSeenFiveTimes);
  ThreadPool pool(1);
  EXPECT_EQ(AbsorbStrayVoxels(AllIds(map), map, pool), 0);
}

TEST(AbsorbStrayVoxels, LeavesWhatNobodyElseTouches) {
  Map map = CubeAndWall();
  Put(*map.FindMutable(SubmapId(1)), {30, 30, 30}, 0.01f, 1.0f, kSeenFiveTimes);
  ThreadPool pool(1);
  EXPECT_EQ(AbsorbStrayVoxels(AllIds(map), map, pool), 0);
}

TEST(AbsorbStrayVoxels, LeavesLargerPartsOfAnObject) {
  Map map = CubeAndWall();
  for (int i = 0; i < 17; ++i) Put(*map.FindMutable(SubmapId(1)), {21, i, 4}, 0.01f, 1.0f, kSeenFiveTimes);
  ThreadPool pool(1);
  EXPECT_EQ(AbsorbStrayVoxels(AllIds(map), map, pool), 0);
}

TEST(AbsorbStrayVoxels, LeavesSubmapsThatAreNotNamed) {
  Map map = CubeAndWall();
  Put(*map.FindMutable(SubmapId(1)), {20, 4, 4}, 0.01f, 1.0f, kSeenFiveTimes);
  const auto before = map.Publish(0);
  ThreadPool pool(1);
  EXPECT_EQ(AbsorbStrayVoxels(std::vector<SubmapId>{SubmapId(2)}, map, pool), 0);
  EXPECT_EQ(map.Publish(0), before);
}

class StrayMaps : public ::testing::TestWithParam<unsigned> {};

TEST_P(StrayMaps, StayExclusiveAndConserveCountsAndWeight) {
  Map map = RandomMap(GetParam());
  ThreadPool pool(2);
  ManageLabels(AllIds(map), map, pool);
  Map other(map.Freeze());
  const auto before = Sum(map);
  AbsorbStrayVoxels(AllIds(map), map, pool);
  const auto after = Sum(map);
  EXPECT_EQ(after.classes, before.classes);
  EXPECT_EQ(after.weight, before.weight);
  std::set<VoxelIndex> held;
  ForEachVoxel(map, [&](const Submap&, const BlockEntry& entry, int i) {
    EXPECT_TRUE(held.insert(VoxelIn(entry.index, i)).second) << "held twice";
  });
  ThreadPool single(1);
  AbsorbStrayVoxels(AllIds(other), other, single);
  EXPECT_TRUE(testing::MapsAreEqual(*map.Freeze(), *other.Freeze()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, StrayMaps, ::testing::Range(0u, 8u));

}  // namespace
}  // namespace dhpmap
