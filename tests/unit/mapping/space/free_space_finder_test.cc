// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/free_space_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "mapping/space/camera_view.h"
#include "mapping/space/lidar_view.h"
#include "mapping/space/look_options.h"
#include "tests/unit/mapping/space/looked_through_scene.h"

namespace dhpmap {
namespace {

using testing::ForEachVoxel;
using testing::FurnishedRoom;
using testing::MapOfLooks;
using testing::RoomFrame;
using testing::Scan;
using testing::Scene;
using testing::Solid;

using Content = std::map<TileIndex, FreeTile>;

Content ContentOf(const Map& map, bool with_stamps = true) {
  Content content;
  for (const FreeTileEntry& entry : map.free_space().tiles()) {
    FreeTile& tile = content[entry.index] = *entry.tile;
    if (!with_stamps) tile.set_last_seen_ns(0);
  }
  return content;
}

/// Depth without any order: every cell of every size is told from others that differ.
PanopticFrame NoisyFrame(unsigned seed) {
  PanopticFrame frame = RoomFrame(static_cast<int>(seed), FurnishedRoom());
  frame.T_map_sensor.rotate(Eigen::AngleAxisd(0.3 * seed, Eigen::Vector3d(1, 2, 3).normalized()));
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> factor(0.8f, 1.3f);
  float times = 1;
  for (float& z : frame.camera->depth_m) {
    if (random() % 40 == 0) times = factor(random);
    z = random() % 9 == 0 ? 0 : z * times;
  }
  return frame;
}

/// Every voxel around the sensor tested by itself, in the octants that the grid has.
template <typename View>
std::int64_t CountDifferences(const View& view, const PanopticFrame& frame, const Map& map, std::int64_t& num_free) {
  const double voxel_size_m = map.info().config.voxel_size_m;
  const Eigen::Vector3d eye = frame.T_map_sensor.translation();
  const Box box = view.Reach();
  std::int64_t num_different = 0;
  ForEachVoxel(eye + voxel_size_m * box.least_vox, eye + voxel_size_m * box.most_vox, voxel_size_m, [&](VoxelIndex v) {
    if ((v.x & 3) != 0 || (v.y & 3) != 0 || (v.z & 3) != 0) return;
    const VoxelIndex base = VoxelAt(eye, voxel_size_m);
    const Eigen::Vector3d offset = eye / voxel_size_m - Eigen::Vector3d(base.x, base.y, base.z);
    const Eigen::Vector3f first =
        (Eigen::Vector3d(v.x - base.x, v.y - base.y, v.z - base.z) - offset + Eigen::Vector3d::Constant(0.5))
            .cast<float>();
    std::array<std::uint8_t, kOctantVoxels> is_free;
    view.Test(first.x(), first.y(), first.z(), is_free);
    for (int i = 0; i < kOctantVoxels; ++i) {
      const bool found = map.free_space().IsFree({v.x + (i & 3), v.y + (i >> 2 & 3), v.z + (i >> 4)});
      num_different += found != (is_free[static_cast<std::size_t>(i)] != 0);
      num_free += found;
    }
  });
  return num_different;
}

TEST(FreeSpaceFinder, WholeCellsOfACameraAreToldAsTheirVoxelsWouldBe) {
  ThreadPool pool(1);
  for (unsigned seed = 0; seed < 4; ++seed) {
    const PanopticFrame frame = NoisyFrame(seed);
    const Map map = MapOfLooks({}, {frame});
    CameraView view;
    view.Build(*frame.camera, frame.T_map_sensor.linear().transpose(), {0.04, 0.08, 5.0}, pool);
    std::int64_t num_free = 0;
    // A voxel whose centre lies on a pixel's border may round to either side.
    EXPECT_LE(CountDifferences(view, frame, map, num_free), num_free / 10'000);
    EXPECT_GT(num_free, 10'000);
  }
}

/// The points within an angle of a direction, which has azimuth `middle`.
void KeepSector(double middle, double half_width, PanopticFrame& frame) {
  std::erase_if(frame.lidar->points_m, [&](const Eigen::Vector3f& p) {
    const double azimuth = std::atan2(double{p.y()}, double{p.x()});
    return std::abs(std::remainder(azimuth - middle, 2 * M_PI)) > half_width;
  });
}

TEST(FreeSpaceFinder, WholeCellsOfALidarAreToldAsTheirVoxelsWouldBe) {
  ThreadPool pool(1);
  Transform pose = Transform::Identity();
  pose.translate(Eigen::Vector3d(0.3, 0.1, 1.2)).rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -1, 4).normalized()));
  const PanopticFrame all_around = Scan(FurnishedRoom(), pose, 32, -25, 20, 600);
  MapConfig config;
  config.voxel_size_m = 0.05;
  config.truncation_m = 0.15;
  // All around; ahead; across the seam; beside it.
  for (const auto& [middle, half_width] : {std::pair{0.0, M_PI}, {0.0, 0.7}, {M_PI, 0.7}, {2.4, 0.7}}) {
    PanopticFrame frame = all_around;
    KeepSector(middle, half_width, frame);
    const Map map = MapOfLooks(config, {frame});
    LidarView view;
    view.Build(*frame.lidar, pose.linear().transpose(), {0.05, 0.15, 5.0}, pool);
    std::int64_t num_free = 0;
    EXPECT_LE(CountDifferences(view, frame, map, num_free), num_free / 10'000);
    EXPECT_GT(num_free, 10'000);
  }
}

TEST(FreeSpaceFinder, AnyNumberOfThreadsAndAnyOrderOfFramesGivesTheSameVoxels) {
  std::vector<PanopticFrame> frames;
  for (int i = 0; i < 5; ++i) frames.push_back(RoomFrame(i, FurnishedRoom()));
  const Map map = MapOfLooks({}, frames, 1);
  EXPECT_EQ(ContentOf(map), ContentOf(MapOfLooks({}, frames, 4)));
  std::reverse(frames.begin(), frames.end());
  EXPECT_EQ(ContentOf(map, false), ContentOf(MapOfLooks({}, frames, 2), false));
}

TEST(FreeSpaceFinder, FarFromTheOriginOfTheMapItIsTheSame) {
  const PanopticFrame near = RoomFrame(1, FurnishedRoom());
  PanopticFrame far = near;
  const std::int32_t tiles = 300'000;  // 380 km
  far.T_map_sensor.translation().x() += tiles * 32 * 0.04;
  const Content there = ContentOf(MapOfLooks({}, {far}));
  std::int64_t num_near = 0, num_same = 0;
  for (const auto& [index, tile] : ContentOf(MapOfLooks({}, {near}))) {
    num_near += tile.NumFreeVoxels();
    const auto it = there.find({index.x + tiles, index.y, index.z});
    if (it != there.end()) num_same += std::min(tile.NumFreeVoxels(), it->second.NumFreeVoxels());
  }
  EXPECT_GE(num_same, num_near * 999 / 1000);
}

/// A wall `range_m` before a camera at the origin that looks along x.
PanopticFrame WallFrame(double range_m) {
  PanopticFrame frame;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = {64, 48, 40, 40, 32, 24};
  data.depth_m.assign(64 * 48, static_cast<float>(range_m));
  frame.T_map_sensor = testing::LookAt({0, 0, 0}, {1, 0, 0});
  return frame;
}

/// How far along x it is free, in voxels of 4 cm.
int FreeAlongX(const Map& map) {
  int x = 1;  // from one that is not about the sensor
  while (map.free_space().IsFree({x, 0, 0})) ++x;
  return x;
}

TEST(FreeSpaceFinder, FreesUpToTheTruncationBeforeAReturnAndUpToTheRangeLimitBeforeOneBeyondIt) {
  EXPECT_EQ(FreeAlongX(MapOfLooks({}, {WallFrame(2.0)})), 48);    // 1.92 m
  EXPECT_EQ(FreeAlongX(MapOfLooks({}, {WallFrame(4.99)})), 123);  // 4.91 m: the last centre is at 4.90
  EXPECT_EQ(FreeAlongX(MapOfLooks({}, {WallFrame(9.0)})), 125);   // 5 m
  MapConfig config;
  config.integration.max_range_m = 10'000;
  config.voxel_size_m = 0.001;
  config.truncation_m = 0.002;
  const Map fine = MapOfLooks(config, {WallFrame(50.0)});
  EXPECT_TRUE(fine.free_space().IsFree({500, 0, 0}));
  EXPECT_FALSE(fine.free_space().IsFree({kMaxSight_vox + 1, 0, 0})) << "what one frame may cost is bounded";
}

TEST(FreeSpaceFinder, NoReturnFreesNothing) {
  for (const float nothing : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    EXPECT_TRUE(MapOfLooks({}, {WallFrame(nothing)}).free_space().empty()) << nothing;
  }
  PanopticFrame empty;
  empty.lidar.emplace();
  EXPECT_TRUE(MapOfLooks({}, {empty}).free_space().empty());
  empty.lidar->points_m.assign(100, Eigen::Vector3f::Zero());
  EXPECT_TRUE(MapOfLooks({}, {empty}).free_space().empty());
}

TEST(FreeSpaceFinder, CamerasOfAbsurdSizesAndFocalLengthsAreHarmless) {
  for (const double focal_px : {1e-300, 1e-30, 1e-3, 1e30, 1e300}) {
    PanopticFrame frame = WallFrame(2.0);
    frame.camera->camera.fx_px = focal_px;
    EXPECT_LE(MapOfLooks({}, {frame}).free_space().NumFreeVoxels(), 2'000'000) << focal_px;
    frame.camera->camera.fy_px = focal_px;
    frame.camera->camera.cx_px = 1e300;
    EXPECT_LE(MapOfLooks({}, {frame}).free_space().NumFreeVoxels(), 2'000'000) << focal_px;
  }
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 64}, {64, 1}, {2, 2}, {3, 5}, {16384, 2}}) {
    PanopticFrame frame = WallFrame(2.0);
    frame.camera->camera.width_px = width;
    frame.camera->camera.height_px = height;
    frame.camera->depth_m.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 2.0f);
    EXPECT_LE(MapOfLooks({}, {frame}).free_space().NumFreeVoxels(), 500'000) << width << " x " << height;
  }
}

TEST(FreeSpaceFinder, WhatWasFreeBeforeIsLeftOutButItsTileIsStamped) {
  const PanopticFrame first = RoomFrame(0, FurnishedRoom());
  PanopticFrame later = first;
  later.stamp_ns = first.stamp_ns + 5'000'000'000;
  const Map once = MapOfLooks({}, {first}), twice = MapOfLooks({}, {first, later});
  EXPECT_EQ(ContentOf(once, false), ContentOf(twice, false));
  for (const FreeTileEntry& entry : twice.free_space().tiles()) EXPECT_EQ(entry.tile->last_seen_ns(), later.stamp_ns);
  later.stamp_ns = first.stamp_ns + 1;
  EXPECT_EQ(ContentOf(once), ContentOf(MapOfLooks({}, {first, later}))) << "nothing new: nothing written";
}

}  // namespace
}  // namespace dhpmap
