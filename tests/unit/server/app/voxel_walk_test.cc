// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/voxel_walk.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

/// Submap 1: a plane in 2 x 2 x 1 blocks, looked through `count` times where x is below a block's side.
std::shared_ptr<const MapSnapshot> PlaneLookedThrough(int count) {
  Submap plane = testing::SolidSubmap([](const Eigen::Vector3d& p) { return p.z() - 0.2; }, {0, 0, 0}, {1, 1, 0});
  plane.mutable_info().id = SubmapId(1);
  for (const BlockIndex index : {BlockIndex{0, 0, 0}, BlockIndex{0, 1, 0}}) {
    for (int linear = 0; linear < kBlockVoxels; ++linear) plane.MutableGone(index).Set(linear, count);
  }
  MapInfo info;
  info.config.voxel_size_m = testing::kVoxel_m;
  return std::make_shared<const MapSnapshot>(
      info, std::vector<std::shared_ptr<const Submap>>{std::make_shared<const Submap>(std::move(plane))});
}

std::vector<ObservedVoxel> AllVoxels(const std::shared_ptr<const MapSnapshot>& state, double max_abs_distance_m) {
  auto walk = VoxelWalk::Begin(state, SubmapId(1), max_abs_distance_m);
  EXPECT_TRUE(walk.ok());
  std::vector<ObservedVoxel> voxels;
  while (!walk->is_done()) {
    const auto block = walk->NextBlock();
    voxels.insert(voxels.end(), block.begin(), block.end());
  }
  return voxels;
}

TEST(VoxelWalk, OmitsContradictedVoxels) {
  const auto all = AllVoxels(PlaneLookedThrough(0), 0);
  ASSERT_EQ(all.size(), 4u * kBlockVoxels);
  const auto left = AllVoxels(PlaneLookedThrough(GoneBlock::kContradicted), 0);
  ASSERT_EQ(left.size(), 2u * kBlockVoxels);
  std::vector<ObservedVoxel> expected;
  expected.reserve(left.size());
  for (const ObservedVoxel& voxel : all) {
    if (voxel.centre_m.x() > kBlockSide * testing::kVoxel_m) expected.push_back(voxel);
  }
  ASSERT_EQ(expected.size(), left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(left[i].centre_m, expected[i].centre_m);
    EXPECT_EQ(left[i].distance_m, expected[i].distance_m);
    EXPECT_EQ(left[i].weight, expected[i].weight);
  }
  const std::size_t num_near = AllVoxels(PlaneLookedThrough(0), testing::kVoxel_m).size();
  EXPECT_EQ(AllVoxels(PlaneLookedThrough(GoneBlock::kContradicted), testing::kVoxel_m).size(), num_near / 2);
  EXPECT_GT(num_near, 0u);
}

TEST(VoxelWalk, ContainsDoubtedVoxels) {
  EXPECT_EQ(AllVoxels(PlaneLookedThrough(GoneBlock::kContradicted - 1), 0).size(), 4u * kBlockVoxels);
}

}  // namespace
}  // namespace dhpmap
