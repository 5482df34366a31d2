// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/surface_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using Place = std::tuple<double, double, double>;
Place PlaceOf(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// By asking for each voxel of some blocks and the next one along each axis.
std::vector<Place> Reference(const Submap& submap, int low, int high) {
  const double step_m = submap.info().truncation_m / 8192;
  const auto shown = [&](VoxelIndex voxel) -> std::optional<double> {
    const BlockEntry* block = submap.blocks().Find(BlockOf(voxel));
    const int linear = LinearIndex(voxel);
    if (block == nullptr || block->tsdf == nullptr || !block->Shows(linear)) return std::nullopt;
    return std::nearbyint(static_cast<double>(block->tsdf->distance_m[static_cast<std::size_t>(linear)]) / step_m);
  };
  std::vector<Place> found;
  for (int z = low; z < high; ++z) {
    for (int y = low; y < high; ++y) {
      for (int x = low; x < high; ++x) {
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = shown({x, y, z}), b = shown({x + (axis == 0), y + (axis == 1), z + (axis == 2)});
          if (!a || !b || (*a < 0) == (*b < 0)) continue;
          Eigen::Vector3d p = VoxelCentre({x, y, z}, submap.info().voxel_size_m);
          p[axis] += submap.info().voxel_size_m * *a / (*a - *b);
          found.push_back(PlaceOf(p));
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(SurfaceCrossings, AreThoseBetweenAnyTwoVoxelsThatShowSomething) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> distance(-0.1f, 0.1f);
  for (int repetition = 0; repetition < 5; ++repetition) {
    Submap submap({.id = SubmapId(1), .voxel_size_m = 0.05, .truncation_m = 0.125}, 1);
    for (int n = 0; n < 27; ++n) {
      const BlockIndex index{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      if (random() % 4 == 0) continue;
      for (std::size_t i = 0; i < kBlockVoxels; ++i) {
        submap.MutableTsdf(index).distance_m[i] = distance(random);
        submap.MutableTsdf(index).weight[i] = random() % 3 == 0 ? 0.0f : 1.0f;
        if (random() % 8 == 0) submap.MutableGone(index).Set(static_cast<int>(i), GoneBlock::kContradicted);
      }
    }
    std::vector<Place> found;
    for (const SurfaceCrossing& crossing : FindSurfaceCrossings(submap)) found.push_back(PlaceOf(crossing.p_m));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, Reference(submap, -8, 16));
    EXPECT_GT(found.size(), 1000u);
  }
}

TEST(SurfaceCrossings, OfABallLieOnItAndFaceAway) {
  Map map(testing::SceneInfo());
  Submap& submap = testing::AddThing(map);
  const Eigen::Vector3d center(0.13, -0.21, 0.4);
  testing::ObserveBand(submap, testing::Ball(center, 0.4), testing::CubeAt(center, 0.6));
  const std::vector<SurfaceCrossing> crossings = FindSurfaceCrossings(submap);
  ASSERT_GT(crossings.size(), 500u);
  for (const SurfaceCrossing& crossing : crossings) {
    EXPECT_NEAR((crossing.p_m - center).norm(), 0.4, 0.002);
    EXPECT_GT(crossing.normal.dot((crossing.p_m - center).normalized()), 0.97);
    EXPECT_EQ(crossing.weight, 1);
  }
}

}  // namespace
}  // namespace dhpmap
