// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/observed_sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

constexpr double kSphereVoxel_m = 0.1;

Submap Empty() {
  SubmapInfo info;
  info.voxel_size_m = kSphereVoxel_m;
  return {info, 1};
}

void ObserveVoxel(Submap& submap, VoxelIndex voxel) {
  submap.MutableTsdf(BlockOf(voxel)).weight[LinearIndex(voxel)] = 1;
}

/// From every voxel, by the definition.
BoundingSphere Reference(const Submap& submap) {
  std::vector<Eigen::Vector3d> corners;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (entry.tsdf == nullptr || !entry.tsdf->IsObserved(linear)) continue;
      const Eigen::Vector3d center = VoxelCentre(VoxelIn(entry.index, linear), kSphereVoxel_m);
      for (int corner = 0; corner < 8; ++corner) {
        corners.push_back(center + kSphereVoxel_m / 2 *
                                       Eigen::Vector3d((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1));
      }
    }
  }
  if (corners.empty()) return {};
  Eigen::Vector3d low = corners.front(), high = corners.front();
  for (const Eigen::Vector3d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  BoundingSphere sphere{(low + high) / 2, 0};
  for (const Eigen::Vector3d& corner : corners) {
    sphere.radius_m = std::max(sphere.radius_m, (corner - sphere.center_m).norm());
  }
  return sphere;
}

TEST(SphereOfObserved, OfOneVoxelIsAroundItsCorners) {
  Submap submap = Empty();
  ObserveVoxel(submap, {3, -4, 5});
  const BoundingSphere sphere = SphereOfObserved(submap);
  EXPECT_TRUE(sphere.center_m.isApprox(VoxelCentre({3, -4, 5}, kSphereVoxel_m), 1e-12));
  EXPECT_NEAR(sphere.radius_m, std::sqrt(3.0) * kSphereVoxel_m / 2, 1e-12);
  submap.UpdateBoundingSphere();
  EXPECT_GT(submap.bounding_sphere().radius_m, 7 * sphere.radius_m) << "a whole block's";
}

TEST(SphereOfObserved, IsEmptyIfNothingIsObserved) {
  Submap submap = Empty();
  EXPECT_TRUE(SphereOfObserved(submap).IsEmpty());
  submap.MutableTsdf({0, 0, 0});
  submap.MutableLabels({9, 9, 9});
  EXPECT_TRUE(SphereOfObserved(submap).IsEmpty());
}

TEST(SphereOfObserved, EqualsTheDefinitionOnRandomSubmaps) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    Submap submap = Empty();
    const int reach = 1 << std::uniform_int_distribution(0, 8)(random);
    std::uniform_int_distribution<int> place(-reach, reach);
    for (int i = std::uniform_int_distribution(1, 60)(random); i > 0; --i) {
      ObserveVoxel(submap, {place(random), place(random), place(random)});
    }
    for (int i = 0; i < 5; ++i)
      submap.MutableTsdf({place(random), place(random), place(random)});  // with nothing in it
    const BoundingSphere expected = Reference(submap);
    const BoundingSphere sphere = SphereOfObserved(submap);
    ASSERT_TRUE(sphere.center_m.isApprox(expected.center_m, 1e-9) ||
                (sphere.center_m - expected.center_m).norm() < 1e-9);
    ASSERT_NEAR(sphere.radius_m, expected.radius_m, 1e-9);
  }
}

bool IsOfWhatIsThere(const Submap& submap) {
  const BoundingSphere expected = Reference(submap), sphere = SphereOfObserved(submap);
  return (sphere.center_m - expected.center_m).norm() < 1e-9 && std::abs(sphere.radius_m - expected.radius_m) < 1e-9;
}

TEST(SphereOfObserved, IsThatOfWhatIsThereNowWhicheverCopyWasAskedBeforeAndWrittenTo) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> place(-90, 90), choice(0, 5);
  std::vector<Submap> copies = {Empty()};
  std::uint64_t generation = 1;
  for (int step = 0; step < 600; ++step) {
    Submap& submap = copies[static_cast<std::size_t>(place(random) + 90) % copies.size()];
    const VoxelIndex voxel{place(random), place(random), place(random)};
    const BlockIndex some = submap.blocks().empty() ? BlockIndex{} : submap.blocks().entries().front().index;
    switch (choice(random)) {
      case 0: submap.EraseBlock(some); break;
      case 1: submap.PutLayers(TileOf(some), nullptr, {true, true, true}); break;
      case 2: submap.DropLabels(); break;
      case 3:
        if (copies.size() == 6) break;
        submap.set_generation(++generation);
        copies.push_back(Submap(submap));
        copies.back().set_generation(++generation);
        break;
      default: ObserveVoxel(submap, voxel);
    }
    for (const Submap& any : copies) ASSERT_TRUE(IsOfWhatIsThere(any)) << step;
  }
  const Submap moved = std::move(copies.back());
  EXPECT_TRUE(IsOfWhatIsThere(moved));
  EXPECT_TRUE(IsOfWhatIsThere(copies.back()));  // NOLINT(bugprone-use-after-move): of nothing
}

TEST(SphereOfObserved, FollowsThePose) {
  Submap submap = Empty();
  ObserveVoxel(submap, {0, 0, 0});
  submap.mutable_info().T_map_submap.translation() = Eigen::Vector3d(1, 2, 3);
  EXPECT_TRUE(SphereOfObservedInMap(submap).center_m.isApprox(Eigen::Vector3d(1.05, 2.05, 3.05), 1e-12));
}

}  // namespace
}  // namespace dhpmap
