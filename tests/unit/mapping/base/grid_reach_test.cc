// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/grid_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mapping/base/grid.h"

namespace dhpmap {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(GridReach, HoldsEveryPlaceOnEarthAtVoxelsOf4CmButNotAtThoseOf2Mm) {
  const Eigen::Vector3d utm_m(6.9e5, 5.4e6, 500);
  EXPECT_EQ(WhyBeyondGrid(utm_m, 0.04), "");
  EXPECT_NE(WhyBeyondGrid(utm_m, 0.002), "");
}

TEST(GridReach, EndsWhereItSays) {
  for (const double voxel_size_m : {0.001, 0.04, 10.0}) {
    const double reach_m = GridReach_m(voxel_size_m);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
        p_m[axis] = sign * reach_m;
        EXPECT_EQ(WhyBeyondGrid(p_m, voxel_size_m), "");
        p_m[axis] *= 1 + 1e-9;
        EXPECT_NE(WhyBeyondGrid(p_m, voxel_size_m), "");
      }
    }
  }
}

TEST(GridReach, LeavesRoomForWhatIsAroundAndForMovedGrids) {
  // A sensor and a submap at opposite ends, the submap turned so that all of the distance is along one axis, and the
  // longest ray of the finest grid.
  const double farthest_vox = 2 * std::sqrt(3.0) * kGridReach_vox + 1e7;
  EXPECT_LT(farthest_vox, static_cast<double>(std::numeric_limits<std::int32_t>::max()));
  const VoxelIndex voxel = VoxelAt(Eigen::Vector3d(farthest_vox, -farthest_vox, 0), 1.0);
  EXPECT_EQ(voxel.x, static_cast<std::int32_t>(farthest_vox));
  EXPECT_EQ(VoxelIn(BlockOf(voxel), LinearIndex(voxel)), voxel);
}

TEST(GridReach, SaysWhichAxisTheLimitAndWhatToDo) {
  const std::string problem = WhyBeyondGrid({0, -1e9, 0}, 0.04);
  EXPECT_NE(problem.find("y = -1e+09 m"), std::string::npos) << problem;
  EXPECT_NE(problem.find("+-21474836.48 m"), std::string::npos) << problem;
  EXPECT_NE(problem.find("local frame"), std::string::npos) << problem;
}

TEST(GridReach, HoldsNothingThatIsNotFinite) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) EXPECT_NE(WhyBeyondGrid({0, 0, bad}, 0.04), "");
}

}  // namespace
}  // namespace dhpmap
