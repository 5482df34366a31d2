// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/voxel_sampler.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

constexpr VoxelIndex kSeen{-3, 9, 17}, kUnseen{-4, 9, 17};

/// One observed voxel.
Submap WithOneVoxel() {
  SubmapInfo info;
  info.voxel_size_m = 0.25;
  Submap submap(info, 1);
  TsdfBlock& tsdf = submap.MutableTsdf(BlockOf(kSeen));
  const auto i = static_cast<std::size_t>(LinearIndex(kSeen));
  tsdf.distance_m[i] = 0.125f;
  tsdf.weight[i] = 3;
  tsdf.color[i] = {1, 2, 3};
  return submap;
}

TEST(VoxelSampler, ReadsTheVoxelAtAnIndex) {
  const Submap submap = WithOneVoxel();
  const VoxelSample sample = SampleVoxel(submap, kSeen);
  ASSERT_TRUE(sample.IsObserved());
  EXPECT_EQ(sample.distance_m(), 0.125f);
  EXPECT_EQ(sample.weight(), 3);
  EXPECT_EQ(sample.color(), (Color{1, 2, 3}));
}

TEST(VoxelSampler, FindsTheVoxelThatHoldsAPoint) {
  const Submap submap = WithOneVoxel();
  const Eigen::Vector3d corner = VoxelCentre(kSeen, 0.25) - Eigen::Vector3d::Constant(0.125);
  EXPECT_TRUE(SampleVoxelAt(submap, corner).IsObserved()) << "the lower corner belongs to a voxel";
  EXPECT_TRUE(SampleVoxelAt(submap, corner + Eigen::Vector3d::Constant(0.2499)).IsObserved());
  EXPECT_FALSE(SampleVoxelAt(submap, corner + Eigen::Vector3d(0.25, 0, 0)).IsObserved()) << "the upper one does not";
}

TEST(VoxelSampler, KnowsNothingOfVoxelsThatWereNotObserved) {
  EXPECT_FALSE(SampleVoxel(WithOneVoxel(), kUnseen).IsObserved()) << "in a block";
  EXPECT_FALSE(SampleVoxel(WithOneVoxel(), {100, 0, 0}).IsObserved()) << "without a block";
}

TEST(VoxelSampler, KnowsNothingOfABlockWithoutGeometry) {
  SubmapInfo info;
  info.voxel_size_m = 0.25;
  Submap submap(info, 1);
  submap.PutBlock(BlockOf(kSeen), nullptr, std::make_shared<LabelBlock>());
  EXPECT_FALSE(SampleVoxel(submap, kSeen).IsObserved());
}

}  // namespace
}  // namespace dhpmap
