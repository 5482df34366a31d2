// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/submap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dhpmap {
namespace {

Submap EmptySubmap() {
  SubmapInfo info;
  info.id = SubmapId(3);
  info.voxel_size_m = 0.04;
  return {info, 1};
}

void ObserveBlock(Submap& submap, BlockIndex index) { submap.MutableTsdf(index).weight[0] = 1; }

/// Distance from the sphere's centre to the farthest corner of any block.
double FarthestCorner(const Submap& submap) {
  double farthest_m = 0;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int c = 0; c < 8; ++c) {
      const BlockIndex corner{entry.index.x + (c & 1), entry.index.y + (c >> 1 & 1), entry.index.z + (c >> 2 & 1)};
      const Eigen::Vector3d p = BlockCorner(corner, submap.info().voxel_size_m);
      farthest_m = std::max(farthest_m, (p - submap.bounding_sphere().center_m).norm());
    }
  }
  return farthest_m;
}

TEST(BoundingSphere, OfASubmapReachesExactlyToTheFarthestBlockCorner) {
  std::mt19937 random(2);
  for (int round = 0; round < 50; ++round) {
    Submap submap = EmptySubmap();
    std::uniform_int_distribution<int> coordinate(-round - 1, round);
    for (int i = 0; i <= round; ++i) ObserveBlock(submap, {coordinate(random), coordinate(random), coordinate(random)});
    submap.UpdateBoundingSphere();
    EXPECT_NEAR(submap.bounding_sphere().radius_m, FarthestCorner(submap), 1e-9);
  }
}

TEST(BoundingSphere, OfOneBlockIsTheSphereAroundIt) {
  Submap submap = EmptySubmap();
  ObserveBlock(submap, {-1, 2, 0});
  submap.UpdateBoundingSphere();
  const double side_m = kBlockSide * 0.04;
  EXPECT_TRUE(submap.bounding_sphere().center_m.isApprox(Eigen::Vector3d(-0.5, 2.5, 0.5) * side_m, 1e-12));
  EXPECT_NEAR(submap.bounding_sphere().radius_m, std::sqrt(3.0) / 2 * side_m, 1e-12);
}

TEST(BoundingSphere, ShrinksWhenBlocksGoAndEmptiesWithTheLast) {
  Submap submap = EmptySubmap();
  ObserveBlock(submap, {0, 0, 0});
  ObserveBlock(submap, {100, 0, 0});
  submap.UpdateBoundingSphere();
  EXPECT_GT(submap.bounding_sphere().radius_m, 15.0);
  EXPECT_TRUE(submap.EraseBlock({100, 0, 0}));
  submap.UpdateBoundingSphere();
  EXPECT_LT(submap.bounding_sphere().radius_m, 0.3);
  EXPECT_TRUE(submap.EraseBlock({0, 0, 0}));
  submap.UpdateBoundingSphere();
  EXPECT_TRUE(submap.bounding_sphere().IsEmpty());
  EXPECT_FALSE(submap.bounding_sphere().Contains(Eigen::Vector3d::Zero()));
}

TEST(BoundingSphere, MovesWithThePoseOfItsSubmap) {
  Submap submap = EmptySubmap();
  ObserveBlock(submap, {5, 0, 0});
  submap.UpdateBoundingSphere();
  Transform T = Transform::Identity();
  T.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(0, 0, 9);
  submap.mutable_info().T_map_submap = T;
  const BoundingSphere in_map = submap.BoundingSphereInMap();
  EXPECT_TRUE(in_map.center_m.isApprox(T * submap.bounding_sphere().center_m, 1e-12));
  EXPECT_EQ(in_map.radius_m, submap.bounding_sphere().radius_m);
  EXPECT_TRUE(in_map.Contains(T * Eigen::Vector3d(5.5 * 0.32, 0.16, 0.16)));
}

TEST(BoundingSphere, IntersectsWhatItTouchesAndNothingIfEmpty) {
  const BoundingSphere a{{0, 0, 0}, 1}, touching{{3, 0, 0}, 2}, apart{{3.1, 0, 0}, 2}, empty{};
  EXPECT_TRUE(a.Intersects(touching));
  EXPECT_FALSE(a.Intersects(apart));
  EXPECT_FALSE(a.Intersects(empty));
  EXPECT_FALSE(empty.Intersects(empty));
}

TEST(Submap, PrunesBlocksWithoutObservedVoxelsAndWithoutLabels) {
  Submap submap = EmptySubmap();
  ObserveBlock(submap, {0, 0, 0});
  submap.MutableTsdf({1, 0, 0});
  submap.MutableLabels({1, 0, 0});
  submap.MutableLabels({2, 0, 0});
  submap.MutableTsdf({3, 0, 0});
  submap.MutableLabels({3, 0, 0}).AddObservation(17, ClassId(1));
  EXPECT_EQ(submap.PruneBlocks(), 2);
  EXPECT_NE(submap.blocks().Find({0, 0, 0}), nullptr);
  EXPECT_NE(submap.blocks().Find({3, 0, 0}), nullptr) << "its labels would be lost";
  EXPECT_EQ(submap.PruneBlocks(), 0);
}

TEST(Submap, DropsLabelsAndKeepsGeometry) {
  Submap submap = EmptySubmap();
  ObserveBlock(submap, {0, 0, 0});
  submap.MutableLabels({0, 0, 0}).AddObservation(0, ClassId(1));
  submap.DropLabels();
  EXPECT_EQ(submap.blocks().Find({0, 0, 0})->labels, nullptr);
  EXPECT_NE(submap.blocks().Find({0, 0, 0})->tsdf, nullptr);
}

TEST(Submap, CopyAndOriginalDivergeOnceBlocksAreShared) {
  Submap original = EmptySubmap();
  original.MutableTsdf({0, 0, 0}).distance_m[5] = 1;
  original.MutableLabels({0, 0, 0}).AddObservation(5, ClassId(1));
  original.ShareBlocks();
  Submap copy = original;
  EXPECT_EQ(copy.blocks().Find({0, 0, 0})->tsdf, original.blocks().Find({0, 0, 0})->tsdf);

  copy.MutableTsdf({0, 0, 0}).distance_m[5] = 2;
  original.MutableTsdf({0, 0, 0}).distance_m[5] = 3;
  copy.MutableLabels({0, 0, 0}).AddObservation(5, ClassId(1));
  EXPECT_EQ(copy.blocks().Find({0, 0, 0})->tsdf->distance_m[5], 2);
  EXPECT_EQ(original.blocks().Find({0, 0, 0})->tsdf->distance_m[5], 3);
  EXPECT_EQ(copy.blocks().Find({0, 0, 0})->labels->NumObservations(5), 2u);
  EXPECT_EQ(original.blocks().Find({0, 0, 0})->labels->NumObservations(5), 1u);
}

TEST(Submap, WritesInPlaceWithinItsGenerationAndCopiesLoadedBlocks) {
  Submap submap = EmptySubmap();
  TsdfBlock* const first = &submap.MutableTsdf({0, 0, 0});
  EXPECT_EQ(&submap.MutableTsdf({0, 0, 0}), first);

  auto loaded = std::make_shared<TsdfBlock>();
  loaded->weight[9] = 4;
  submap.PutBlock({1, 0, 0}, loaded, nullptr);
  submap.MutableTsdf({1, 0, 0}).weight[9] = 5;
  EXPECT_EQ(loaded->weight[9], 4);
  EXPECT_EQ(submap.blocks().Find({1, 0, 0})->tsdf->weight[9], 5);
}

TEST(Submap, ElectsTheMostSeenClassUnlessItIsFixed) {
  Submap submap = EmptySubmap();
  submap.AddClassObservations(ClassId(8), 3);
  EXPECT_EQ(submap.info().class_id, ClassId(8));
  submap.AddClassObservations(ClassId(2), 3);
  EXPECT_EQ(submap.info().class_id, ClassId(2)) << "ties go to the smaller id";
  EXPECT_FLOAT_EQ(submap.info().ClassConfidence(), 0.5f);
  submap.AddClassObservations(ClassId(8), 6'000'000'000);
  EXPECT_EQ(submap.info().class_id, ClassId(8));
  submap.mutable_info().class_is_fixed = true;
  submap.mutable_info().class_id = ClassId(5);
  submap.AddClassObservations(ClassId(8), 1);
  EXPECT_EQ(submap.info().class_id, ClassId(5));
  EXPECT_EQ(submap.info().ClassConfidence(), 0.0f);
}

TEST(Submap, ABackgroundKeepsTheClassThatItWasMadeFor) {
  Submap submap = EmptySubmap();
  submap.mutable_info().panoptic = Panoptic::kStuff;
  submap.mutable_info().class_id = ClassId(8);
  submap.AddClassObservations(ClassId(2), 3);
  EXPECT_EQ(submap.info().class_id, ClassId(8)) << "or there would soon be two of one class";
  EXPECT_EQ(submap.info().class_counts, (std::vector<ClassTotal>{{ClassId(2), 3}}));
}

TEST(SubmapInfo, WhatWasRelabelledIsStillMeantByTheClassThatItWasSeenAs) {
  SubmapInfo info;
  info.class_id = ClassId(2);
  info.class_counts = {{ClassId(1), 3}, {ClassId(2), 9}};
  EXPECT_TRUE(info.IsSeenAs(ClassId(2)));
  EXPECT_FALSE(info.IsSeenAs(ClassId(1)));
  EXPECT_FALSE(IsEdited(info));
  info.class_id = ClassId(5);
  EXPECT_FALSE(info.IsSeenAs(ClassId(2))) << "as long as nobody has set it";
  info.class_is_fixed = true;
  EXPECT_TRUE(info.IsSeenAs(ClassId(5)));
  EXPECT_TRUE(info.IsSeenAs(ClassId(2)));
  EXPECT_FALSE(info.IsSeenAs(ClassId(1)));
  EXPECT_TRUE(IsEdited(info));
}

TEST(SubmapInfo, WhatWasRelabelledIsMeantByItsOldClassThoughFramesHaveUsedTheNewOneSince) {
  SubmapInfo info;
  info.class_id = ClassId(5);
  info.class_is_fixed = true;
  info.class_counts = {{ClassId(2), 10}, {ClassId(3), 9}, {ClassId(5), 11}};
  EXPECT_TRUE(info.IsSeenAs(ClassId(2)));
  EXPECT_FALSE(info.IsSeenAs(ClassId(3))) << "less than a third";
  info.class_counts = {{ClassId(1), 1}, {ClassId(2), 3}, {ClassId(3), 2}, {ClassId(4), 2}, {ClassId(6), 2}};
  EXPECT_TRUE(info.IsSeenAs(ClassId(2))) << "the most frequent, though less than a third";
  EXPECT_FALSE(info.IsSeenAs(ClassId(3)));
}

}  // namespace
}  // namespace dhpmap
