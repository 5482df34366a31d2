// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/tsdf_sampler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mapping/query/voxel_sampler.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kSceneVoxel_m;
using testing::TsdfSampler;

/// Of all eight voxels around, by the formula; NaN if one was not observed.
double Trilinear(const Submap& submap, const Eigen::Vector3d& p) {
  const Eigen::Vector3d at = p / kSceneVoxel_m - Eigen::Vector3d::Constant(0.5);
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Array3i low = at.array().floor().cast<int>();
    const Eigen::Array3i voxel = low + Eigen::Array3i(k & 1, k >> 1 & 1, k >> 2 & 1);
    const Eigen::Array3d near = 1 - (at.array() - voxel.cast<double>()).abs();
    const VoxelSample sample = SampleVoxel(submap, {voxel.x(), voxel.y(), voxel.z()});
    sum += near.prod() * (sample.IsObserved() ? sample.distance_m() : std::nan(""));
  }
  return sum;
}

TEST(TsdfSampler, EqualsTheFormulaInOneBlockAndOverTheirBorders) {
  Map map(testing::SceneInfo());
  Submap& submap = testing::AddThing(map);
  testing::ObserveBand(submap, testing::Ball({0.1, 0.2, -0.1}, 0.5), testing::CubeAt({0, 0, 0}, 0.9));
  TsdfSampler sampler(submap);
  int num_known = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(5000, 0.8, 4)) {
    const double truth = Trilinear(submap, p);
    const TsdfSampler::Sample sample = sampler.Between(p);
    ASSERT_EQ(sample.is_known, !std::isnan(truth)) << p.transpose();
    if (!sample.is_known) continue;
    ++num_known;
    EXPECT_NEAR(sample.distance_m, truth, 1e-6);
    constexpr double kStep_m = 1e-4;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(axis);
      const auto cell_of = [](const Eigen::Vector3d& q) -> Eigen::Array3d {
        return ((q / kSceneVoxel_m).array() - 0.5).floor();
      };
      if ((cell_of(p + step) != cell_of(p - step)).any()) continue;  // over a centre
      const double slope = (Trilinear(submap, p + step) - Trilinear(submap, p - step)) / (2 * kStep_m);
      if (std::isnan(slope)) continue;
      EXPECT_NEAR(sample.gradient[axis], slope, 2e-3);
    }
  }
  EXPECT_GT(num_known, 500);
}

TEST(TsdfSampler, ReadsVoxelsAsTheyAre) {
  Map map(testing::SceneInfo());
  Submap& submap = testing::AddThing(map);
  testing::ObserveBand(submap, testing::Ball({0, 0, 0}, 0.4), testing::CubeAt({0, 0, 0}, 0.6));
  TsdfSampler sampler(submap);
  for (const Eigen::Vector3d& p : testing::RandomPoints(3000, 0.7, 4)) {
    const VoxelIndex voxel = VoxelAt(p, kSceneVoxel_m);
    const VoxelSample truth = SampleVoxel(submap, voxel);
    const float value = sampler.At(voxel);
    EXPECT_EQ(std::isnan(value), !truth.IsObserved());
    if (!truth.IsObserved()) continue;
    EXPECT_EQ(value, truth.distance_m());
  }
}

TEST(TsdfSampler, KnowsNothingOfAnEmptySubmap) {
  Map map(testing::SceneInfo());
  TsdfSampler sampler(testing::AddThing(map));
  EXPECT_TRUE(std::isnan(sampler.At({0, 0, 0})));
  EXPECT_FALSE(sampler.Between({0, 0, 0}).is_known);
}

}  // namespace
}  // namespace dhpmap
