// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/kept_clear_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "mapping/fusion/kept_clear_voxels.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

double Uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Eigen::Vector3d AnyPoint(std::mt19937& random, double reach_m) {
  return {Uniform(random, -reach_m, reach_m), Uniform(random, -reach_m, reach_m), Uniform(random, -reach_m, reach_m)};
}

/// Boxes and spheres of all sizes, near and far, some with the sensor in them.
KeptClear AnyRegions(std::mt19937& random, int count) {
  KeptClear regions;
  for (int n = 0; n < count; ++n) {
    const Eigen::Vector3d center_m = AnyPoint(random, 5);
    const double size_m = std::pow(10.0, Uniform(random, -1.5, 0.7));
    const Eigen::Vector3d half_m(size_m, size_m * Uniform(random, 0.1, 1), size_m * Uniform(random, 0.1, 1));
    Region region = BoundingSphere{center_m, size_m};
    if (n % 2 == 0) region = Eigen::AlignedBox3d(center_m - half_m, center_m + half_m);
    EXPECT_TRUE(regions.Add({"r" + std::to_string(n), region}).ok());
  }
  return regions;
}

bool IsInAny(const KeptClear& regions, const Eigen::Vector3d& p_m) {
  for (const KeptClearRegion& region : regions.list()) {
    if (Contains(region.region, p_m)) return true;
  }
  return false;
}

Transform AnyPose(std::mt19937& random) {
  return Eigen::Translation3d(AnyPoint(random, 3)) *
         Eigen::AngleAxisd(Uniform(random, -3, 3), AnyPoint(random, 1).normalized());
}

/// A camera anywhere that sees something, or nothing, up to 6 m away.
PanopticFrame AnyImage(std::mt19937& random) {
  PanopticFrame frame;
  frame.T_map_sensor = AnyPose(random);
  frame.camera.emplace().camera = testing::SmallCamera();
  for (int i = 0; i < frame.camera->camera.num_pixels(); ++i) {
    frame.camera->depth_m.push_back(i % 97 == 0   ? NAN
                                    : i % 89 == 0 ? -1.0f
                                                  : static_cast<float>(Uniform(random, 0, 6)));
  }
  return frame;
}

/// As many as there may be, which all lie in `sphere`; the last is all of it.
KeptClear ManyWithin(const BoundingSphere& sphere, std::mt19937& random) {
  KeptClear regions;
  for (std::size_t n = 0; n + 1 < KeptClear::kMost; ++n) {
    const double radius_m = sphere.radius_m * Uniform(random, 0.3, 0.9);
    const Eigen::Vector3d half_m = Eigen::Vector3d::Constant(radius_m / 2);
    Region region = BoundingSphere{sphere.center_m, radius_m};
    if (n % 2 == 0) region = Eigen::AlignedBox3d(sphere.center_m - half_m, sphere.center_m + half_m);
    EXPECT_TRUE(regions.Add({"part" + std::to_string(n), region}).ok());
  }
  EXPECT_TRUE(regions.Add({"whole", sphere}).ok());
  return regions;
}

TEST(WithoutKeptClear, LeavesOutExactlyThePixelsOfPointsInRegions) {
  std::mt19937 random(3);
  std::int64_t num_cut = 0, num_kept = 0;
  for (int round = 0; round < 60; ++round) {
    const PanopticFrame frame = AnyImage(random);
    const PinholeCamera& camera = frame.camera->camera;
    const KeptClear regions = AnyRegions(random, 8);
    const auto rest = WithoutKeptClear(frame, regions);
    for (int i = 0; i < camera.num_pixels(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto d = static_cast<double>(frame.camera->depth_m[at]);
      const Eigen::Vector3d p_m((i % camera.width_px - camera.cx_px) / camera.fx_px * d,
                                (i / camera.width_px - camera.cy_px) / camera.fy_px * d, d);
      const bool is_cut = d > 0 && IsInAny(regions, frame.T_map_sensor * p_m);
      num_cut += is_cut;
      num_kept += !is_cut;
      const float left_m = rest ? rest->camera->depth_m[at] : frame.camera->depth_m[at];
      if (is_cut || d > 0) {
        ASSERT_EQ(left_m, is_cut ? 0.0f : frame.camera->depth_m[at]) << "round " << round << ", pixel " << i;
      }
    }
  }
  EXPECT_GT(num_cut, 10'000);
  EXPECT_GT(num_kept, 10'000);
}

TEST(WithoutKeptClear, LeavesThePointsOfAScanOutWithAllThatIsKnownOfThem) {
  std::mt19937 random(4);
  PanopticFrame frame;
  frame.T_map_sensor = AnyPose(random);
  LidarData& scan = frame.lidar.emplace();
  for (std::uint32_t i = 0; i < 5000; ++i) {
    scan.points_m.push_back(AnyPoint(random, 6).cast<float>());
    scan.segments.push_back(i);
    scan.is_hidden.push_back(static_cast<std::uint8_t>(i % 2));
  }
  const KeptClear regions = AnyRegions(random, 5);
  const auto rest = WithoutKeptClear(frame, regions);
  ASSERT_TRUE(rest);
  std::size_t next = 0;
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    if (IsInAny(regions, frame.T_map_sensor * scan.points_m[i].cast<double>())) continue;
    ASSERT_LT(next, rest->lidar->points_m.size());
    EXPECT_EQ(rest->lidar->points_m[next], scan.points_m[i]);
    EXPECT_EQ(rest->lidar->segments[next], scan.segments[i]);
    EXPECT_EQ(rest->lidar->is_hidden[next], scan.is_hidden[i]);
    ++next;
  }
  EXPECT_EQ(rest->lidar->points_m.size(), next);
  EXPECT_LT(next, scan.points_m.size());
  EXPECT_TRUE(rest->lidar->color.empty());
}

TEST(WithoutKeptClear, CutsForRegionsThatOverlapWhatItCutsForTheOneThatHoldsThem) {
  std::mt19937 random(7);
  std::int64_t num_cut = 0;
  for (int round = 0; round < 20; ++round) {
    const PanopticFrame image = AnyImage(random);
    PanopticFrame scan;
    scan.T_map_sensor = image.T_map_sensor;
    scan.lidar.emplace();
    for (int i = 0; i < 3000; ++i) scan.lidar->points_m.push_back(AnyPoint(random, 6).cast<float>());
    const BoundingSphere sphere{AnyPoint(random, 1), 3};
    KeptClear one;
    ASSERT_TRUE(one.Add({"whole", sphere}).ok());
    const KeptClear many = ManyWithin(sphere, random);

    const auto a = WithoutKeptClear(image, one), b = WithoutKeptClear(image, many);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      const std::vector<float>&x = a->camera->depth_m, &y = b->camera->depth_m;
      ASSERT_EQ(x.size(), y.size());
      EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(float)), 0) << "round " << round;
      num_cut += std::count(x.begin(), x.end(), 0.0f);
    }
    const auto c = WithoutKeptClear(scan, one), d = WithoutKeptClear(scan, many);
    ASSERT_TRUE(c && d);
    EXPECT_TRUE(c->lidar->points_m == d->lidar->points_m) << "round " << round;
  }
  EXPECT_GT(num_cut, 10'000);
}

TEST(WithoutKeptClear, LeavesAFrameThatShowsNothingOfThemAsItIs) {
  PanopticFrame frame;
  frame.lidar.emplace().points_m = {{1, 0, 0}, {0, 2, 0}};
  KeptClear regions;
  EXPECT_FALSE(WithoutKeptClear(frame, regions));
  ASSERT_TRUE(regions.Add({"behind", BoundingSphere{{-5, 0, 0}, 1}}).ok());
  EXPECT_FALSE(WithoutKeptClear(frame, regions));
}

TEST(KeptClearVoxels, AreThoseWithTheirCentresInRegions) {
  std::mt19937 random(5);
  int num_in = 0;
  for (int round = 0; round < 200; ++round) {
    SubmapInfo info;
    info.voxel_size_m = 0.05;
    if (round % 2 == 0) info.T_map_submap = AnyPose(random);
    const KeptClear regions = AnyRegions(random, 3);
    KeptClearVoxels voxels(regions, info);
    const auto any = [&random] { return static_cast<std::int32_t>(random() % 20) - 10; };
    const BlockIndex block{any(), any(), any()};
    const VoxelMask* mask = voxels.In(block);
    EXPECT_TRUE(mask == nullptr || voxels.MayBeAround({block.x + 1, block.y - 1, block.z}));
    for (int i = 0; i < kBlockVoxels; ++i) {
      const bool is_in = IsInAny(regions, info.T_map_submap * VoxelCentre(VoxelIn(block, i), info.voxel_size_m));
      ASSERT_EQ(mask != nullptr && IsIn(*mask, i), is_in);
      num_in += is_in;
    }
  }
  EXPECT_GT(num_in, 1000);
}

}  // namespace
}  // namespace dhpmap
