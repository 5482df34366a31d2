// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_runs.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

using Place = std::pair<std::uint32_t, VoxelIndex>;
Place PlaceOf(const PointRun& run) { return {run.place.segment(), run.place.voxel()}; }

IntegrationConfig AllOfOneWeight() {
  IntegrationConfig config;
  config.weighting = Weighting::kConstant;
  config.max_range_m = 100;
  return config;
}

/// Pixels before a wall that is nowhere smooth, of a width that is no multiple of anything.
DepthCameraData NoisyWall(int width_px, int height_px) {
  DepthCameraData data;
  data.camera = {.width_px = width_px, .height_px = height_px, .fx_px = 100, .fy_px = 100, .cx_px = 60, .cy_px = 30};
  std::mt19937 random(2);
  for (int i = 0; i < width_px * height_px; ++i) {
    data.depth_m.push_back(random() % 9 == 0 ? 0.0f : 2.0f + 0.001f * static_cast<float>(random() % 400));
    data.segments.push_back(random() % 4);
    data.color.push_back({static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 7});
  }
  return data;
}

RunBands RunsOf(const DepthCameraData& data, int num_threads) {
  const SensorOnGrid grid(Transform::Identity(), 0.1);
  ThreadPool pool(num_threads);
  FrameTally tally(data.depth_m.size());
  RunBands bands;
  CollectCameraRuns(data, grid, AllOfOneWeight(), pool, tally, bands);
  return bands;
}

struct RunSum {
  std::uint32_t num_points = 0;
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero(), color = Eigen::Vector3d::Zero();
};

/// Pixel by pixel, by band of 16 rows, in single precision where it decides on voxels.
std::vector<std::map<Place, RunSum>> SlowRunSums(const DepthCameraData& data) {
  const PinholeCamera& camera = data.camera;
  std::vector<std::map<Place, RunSum>> bands(static_cast<std::size_t>((camera.height_px + 15) / 16));
  const SensorOnGrid grid(Transform::Identity(), 0.1);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const auto i = static_cast<std::size_t>(v * camera.width_px + u);
      if (!(data.depth_m[i] > 0)) continue;
      const auto x = static_cast<float>((u - camera.cx_px) / camera.fx_px);
      const auto y = static_cast<float>((v - camera.cy_px) / camera.fy_px);
      const Eigen::Vector3f p_m(data.depth_m[i] * x, data.depth_m[i] * y, data.depth_m[i]);
      RunSum& sum = bands[static_cast<std::size_t>(v / 16)][{data.segments[i], grid.VoxelOf(p_m)}];
      ++sum.num_points;
      sum.sum_m += p_m.cast<double>();
      sum.color += Eigen::Vector3d(data.color[i].r, data.color[i].g, data.color[i].b);
    }
  }
  return bands;
}

TEST(PointRuns, HoldEveryPointOfABandAndNearlyEachPlaceOnce) {
  const DepthCameraData data = NoisyWall(301, 50);
  const auto expected = SlowRunSums(data);
  const RunBands bands = RunsOf(data, 1);
  ASSERT_EQ(bands.size(), expected.size());
  std::size_t num_runs = 0, num_places = 0;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    std::map<Place, RunSum> of_place;
    for (const PointRun& run : bands[b]) {
      EXPECT_EQ(run.weight(), static_cast<float>(run.num_points()));
      RunSum& sum = of_place[PlaceOf(run)];
      sum.num_points += run.num_points();
      sum.sum_m += run.weighted_sum_m().cast<double>();
      sum.color += run.color_sum().cast<double>();
    }
    ASSERT_EQ(of_place.size(), expected[b].size());
    for (const auto& [place, sum] : expected[b]) {
      ASSERT_EQ(of_place[place].num_points, sum.num_points);
      ASSERT_TRUE(of_place[place].sum_m.isApprox(sum.sum_m, 1e-5));
      ASSERT_TRUE(of_place[place].color.isApprox(sum.color, 1e-5));
    }
    num_runs += bands[b].size();
    num_places += of_place.size();
  }
  EXPECT_LT(static_cast<double>(num_runs), 1.2 * static_cast<double>(num_places));
}

TEST(PointRuns, AreTheSameForAnyNumberOfThreads) {
  const DepthCameraData data = NoisyWall(301, 50);
  const RunBands one = RunsOf(data, 1), four = RunsOf(data, 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t b = 0; b < one.size(); ++b) {
    ASSERT_EQ(one[b].size(), four[b].size());
    for (std::size_t i = 0; i < one[b].size(); ++i) {
      ASSERT_EQ(one[b][i].place, four[b][i].place);
      ASSERT_TRUE((one[b][i].weighted_m == four[b][i].weighted_m).all());
      ASSERT_TRUE((one[b][i].weighted_color == four[b][i].weighted_color).all());
    }
  }
}

TEST(PointRuns, PlacesThatShareANumberTakeTurns) {
  // Two voxels of one number, seen by turns by a scan: nothing of one is added to the other.
  const std::uint32_t number = PlaceNumber(0, 0, 0, 0);
  VoxelIndex other{1, 0, 0};
  while (PlaceNumber(0, other.x, 0, 0) != number) ++other.x;
  LidarData data;
  for (int i = 0; i < 10; ++i) {
    data.points_m.emplace_back(0.005f, 0.004f, 0.003f);
    data.points_m.emplace_back(0.01f * (static_cast<float>(other.x) + 0.5f), 0.004f, 0.003f);
  }
  IntegrationConfig config = AllOfOneWeight();
  config.min_range_m = 0;
  const SensorOnGrid grid(Transform::Identity(), 0.01);
  ThreadPool pool(1);
  FrameTally tally(data.points_m.size());
  RunBands bands;
  CollectLidarRuns(data, grid, config, pool, tally, bands);
  ASSERT_EQ(bands.size(), 1u);
  std::map<Place, std::uint32_t> of_place;
  for (const PointRun& run : bands[0]) of_place[PlaceOf(run)] += run.num_points();
  EXPECT_EQ(of_place, (std::map<Place, std::uint32_t>{{{0, {0, 0, 0}}, 10}, {{0, other}, 10}}));
}

}  // namespace
}  // namespace dhpmap
