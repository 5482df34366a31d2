// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/voxel_answer.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

constexpr int kVoxel = 17;

/// One block, its voxels seen `count` times as class 9, `distance_m` from the surface; the submap is of class 4.
Submap Labelled(std::uint32_t id, int count, float distance_m, float weight = 1) {
  SubmapInfo info;
  info.id = SubmapId(id);
  info.panoptic = id == 0 ? Panoptic::kUnknown : Panoptic::kThing;
  info.class_id = ClassId(4);
  info.voxel_size_m = 0.1;
  info.truncation_m = 0.3;
  Submap submap(info, 1);
  TsdfBlock& tsdf = submap.MutableTsdf({0, 0, 0});
  tsdf.weight.fill(weight);
  tsdf.distance_m.fill(distance_m);
  for (int i = 0; i < count; ++i) submap.MutableLabels({0, 0, 0}).AddObservation(kVoxel, ClassId(9));
  return submap;
}

BestLabel ClassOf(const Submap& submap) { return ClassOfVoxel(submap, submap.blocks().entries().front(), kVoxel); }
VoxelSupport SupportOf(const Submap& submap) {
  return SupportOfVoxel(submap, submap.blocks().entries().front(), kVoxel);
}

TEST(ClassOfVoxel, IsTheSubmapsWithItsShareOfWhatTheVoxelSaw) {
  Submap submap = Labelled(1, 3, 0);  // three times class 9, in a submap of class 4
  EXPECT_EQ(ClassOf(submap).id, 4u);
  EXPECT_EQ(ClassOf(submap).count, 0u);
  submap.MutableLabels(submap.blocks().entries().front().index).AddObservation(kVoxel, ClassId(4));
  EXPECT_EQ(ClassOf(submap).id, 4u);
  EXPECT_EQ(ClassOf(submap).count, 1u);
  EXPECT_FLOAT_EQ(ClassOf(submap).share, 0.25f);
}

TEST(ClassOfVoxel, IsTheSubmapsWithoutCounts) {
  EXPECT_EQ(ClassOf(Labelled(1, 0, 0)).id, 4u);
  EXPECT_EQ(ClassOf(Labelled(1, 0, 0)).count, 0u);
}

TEST(ClassOfVoxel, IsZeroInTheUnknownSubmap) { EXPECT_EQ(ClassOf(Labelled(0, 0, 0)).id, 0u); }

TEST(SupportOfVoxel, GrowsWithObservationsAndNearness) {
  EXPECT_GT(SupportOf(Labelled(1, 3, 0)), SupportOf(Labelled(2, 2, 0)));
  EXPECT_GT(SupportOf(Labelled(1, 2, 0.0f)), SupportOf(Labelled(2, 4, 0.25f))) << "the object on the wall";
  EXPECT_GT(SupportOf(Labelled(1, 3, -0.3f)), SupportOf(Labelled(2, 2, 0.3f))) << "counts decide at the border";
}

TEST(SupportOfVoxel, WithoutObservationsAKnownSubmapAndThenTheHeavierOneAnswers) {
  EXPECT_GT(SupportOf(Labelled(1, 0, 0, 1)), SupportOf(Labelled(0, 0, 0, 50)));
  EXPECT_GT(SupportOf(Labelled(1, 0, 0, 2)), SupportOf(Labelled(2, 0, 0, 1)));
  EXPECT_FALSE(SupportOf(Labelled(1, 0, 0)) > SupportOf(Labelled(2, 0, 0))) << "a tie goes to who was asked first";
}

}  // namespace
}  // namespace dhpmap
