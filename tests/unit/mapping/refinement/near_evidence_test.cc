// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/near_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mapping/evidence/label_management.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

double KernelAt(double distance, double radius) {
  const double d = distance / radius;
  if (d >= 1) return 0;
  return (2 + std::cos(2 * std::numbers::pi * d)) / 3 * (1 - d) +
         std::sin(2 * std::numbers::pi * d) / (2 * std::numbers::pi);
}

TEST(NearTaps, AreTheKernelWithinItsRadiusButForTheVoxelItself) {
  for (const double radius : {1.5, 2.0, 4.0}) {
    double sum = 0, expected = 0;
    for (const NearTap& tap : NearTaps(radius)) {
      EXPECT_NEAR(tap.weight, KernelAt(std::hypot(tap.x, tap.y, tap.z), radius), 1e-6);
      sum += tap.weight;
    }
    for (int n = 0; n < 11 * 11 * 11; ++n) {
      const double distance = std::hypot(n % 11 - 5, n / 11 % 11 - 5, n / 121 - 5);
      if (distance > 0) expected += KernelAt(distance, radius);
    }
    EXPECT_NEAR(sum, expected, 1e-4);
  }
}

TEST(NearTaps, AreNoneWithoutARadiusAndEndAtABlocksSide) {
  EXPECT_TRUE(NearTaps(0).empty());
  EXPECT_TRUE(NearTaps(1).empty());
  EXPECT_EQ(NearTaps(1000).size(), NearTaps(8).size());
  for (const NearTap& tap : NearTaps(1000)) EXPECT_LT(std::hypot(tap.x, tap.y, tap.z), 8);
}

class GatheredEvidence : public ::testing::TestWithParam<unsigned> {};

TEST_P(GatheredEvidence, IsWhatAllPairsOfVoxelsSay) {
  constexpr double kRadius_vox = 3.5;
  Map map = testing::RandomMap(GetParam());
  ThreadPool pool(1);
  ManageLabels(testing::AllIds(map), map, pool);
  const double voxel_size_m = map.info().config.voxel_size_m;
  const KnownInstances known(testing::AllIds(map), map);
  const auto blocks = CollectBlocks(testing::AllIds(map), map);
  const std::vector<CrfTile> tiles = CutTiles(blocks, known, 2, 1, pool);
  ASSERT_FALSE(tiles.empty());
  for (const CrfTile& tile : tiles) {
    const TileProblem problem(blocks, known, tile, 1, voxel_size_m);
    const auto evidence = GatherEvidence(problem, kRadius_vox, voxel_size_m);
    const auto stride = static_cast<std::size_t>(problem.channels().num_channels());
    std::vector<double> expected(evidence.size(), 0.0);
    for (const TileProblem::Member& from : problem.members()) {
      const double distance_m = problem.BlockOf(from).entry->tsdf->distance_m[from.linear];
      const VoxelIndex a = VoxelIn(problem.BlockOf(from).index, from.linear);
      for (std::size_t m = 0; m < problem.members().size(); ++m) {
        const TileProblem::Member& to = problem.members()[m];
        const VoxelIndex b = VoxelIn(problem.BlockOf(to).index, to.linear);
        const double distance_vox = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
        double weight = distance_vox == 0 ? 1.0 : kNearWeight * KernelAt(distance_vox, kRadius_vox);
        if (distance_vox > 0 && std::abs(distance_m) > 1.5 * voxel_size_m) weight = 0;
        problem.VisitSeen(from,
                          [&](std::uint32_t c, std::uint32_t count) { expected[m * stride + c] += weight * count; });
      }
    }
    for (std::size_t i = 0; i < evidence.size(); ++i) EXPECT_NEAR(evidence[i], expected[i], 1e-4 * (1 + expected[i]));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, GatheredEvidence, ::testing::Range(0u, 4u));

}  // namespace
}  // namespace dhpmap
