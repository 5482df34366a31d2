// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/band_size.h"

#include <gtest/gtest.h>

#include <random>

#include "mapping/fusion/bundler.h"
#include "mapping/map/map.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

constexpr double kBandVoxel_m = 0.02, kBandTruncation_m = 0.06;

/// Every pixel at a depth of its own, far from its neighbours': nothing shares a block that need not.
PanopticFrame Noise(double nearest_m, double farthest_m) {
  PanopticFrame frame;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = testing::SmallCamera();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> depth_m(static_cast<float>(nearest_m), static_cast<float>(farthest_m));
  for (int i = 0; i < data.camera.num_pixels(); ++i) data.depth_m.push_back(depth_m(random));
  frame.T_map_sensor = testing::LookAt({0.3, -0.2, 1.1}, {2, 1, 0.2});
  return frame;
}

struct Counted {
  std::size_t touched, bound, shortcut;
};

/// Blocks that fusing the frame really makes, and what is said before.
Counted Count(const PanopticFrame& frame) {
  MapInfo info;
  info.config.voxel_size_m = kBandVoxel_m;
  info.config.truncation_m = kBandTruncation_m;
  ThreadPool pool(1);
  Bundler bundler(info.config.integration, pool);
  const auto& segments = bundler.BundleFrame(frame, frame.T_map_sensor, kBandVoxel_m);
  const RayOrigin origin(frame.T_map_sensor.translation(), kBandVoxel_m);
  Map map(info);
  Submap& submap = *map.FindMutable(kUnknownSubmap);
  for (const SegmentBundles& segment : segments) {
    IntegrateSegment(segment, origin, {}, info.config.integration, submap);
  }
  constexpr std::size_t kNoLimit = 1'000'000'000;
  return {submap.blocks().size(), CountBandBlocks(segments, origin, kBandVoxel_m, kBandTruncation_m, 1),
          CountBandBlocks(segments, origin, kBandVoxel_m, kBandTruncation_m, kNoLimit)};
}

/// The full count, which stops only where `enough` is passed.
std::size_t CountUpTo(const PanopticFrame& frame, std::size_t enough) {
  IntegrationConfig config;
  ThreadPool pool(1);
  Bundler bundler(config, pool);
  const auto& segments = bundler.BundleFrame(frame, frame.T_map_sensor, kBandVoxel_m);
  return CountBandBlocks(segments, RayOrigin(frame.T_map_sensor.translation(), kBandVoxel_m), kBandVoxel_m,
                         kBandTruncation_m, enough);
}

TEST(CountBandBlocks, IsNeverLessThanWhatIsTouched) {
  for (const double nearest_m : {0.11, 1.0, 4.0}) {
    const PanopticFrame frame = Noise(nearest_m, 5.0);
    const Counted counted = Count(frame);
    ASSERT_GT(counted.touched, 1000u);
    EXPECT_GE(CountUpTo(frame, counted.touched), counted.touched) << nearest_m;
    EXPECT_GE(counted.shortcut, counted.touched) << nearest_m;
    EXPECT_GT(counted.bound, 1u) << "it says when there is more than enough";
  }
}

TEST(CountBandBlocks, CountsRaysThatAreWalkedOn) {
  // A road that is grazed: rays go through several blocks.
  PanopticFrame frame;
  frame.lidar.emplace();
  for (float x_m = 1.5f; x_m < 4.5f; x_m += 0.05f) {
    for (float y_m = -2; y_m < 2; y_m += 0.008f) frame.lidar->points_m.emplace_back(x_m, y_m, -0.3f);
  }
  const Counted counted = Count(frame);
  ASSERT_LT(counted.touched, counted.shortcut);
  EXPECT_GE(CountUpTo(frame, counted.shortcut - 1), counted.touched);
}

TEST(CountBandBlocks, IsNotMuchMoreThanWhatIsTouched) {
  // Just below the shortcut, so that every ray is looked at.
  const PanopticFrame frame = Noise(1.0, 5.0);
  const Counted counted = Count(frame);
  const std::size_t careful = CountUpTo(frame, counted.shortcut - 1);
  EXPECT_LT(careful, counted.touched * 3 / 2) << counted.touched;
  EXPECT_GE(careful, counted.touched);
}

TEST(CountBandBlocks, SurfacesOfARoomAreFarBelowTheLimit) {
  PanopticFrame wall = Noise(2.0, 2.01);
  EXPECT_LT(CountUpTo(wall, kMaxBlocksAFrame), kMaxBlocksAFrame / 4);
}

}  // namespace
}  // namespace dhpmap
