// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_runs.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <tuple>
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

TEST(PointRuns, HoldEveryPointOnceAndNearlyEachPlaceOfABandOnce) {
  const DepthCameraData data = NoisyWall(301, 50);
  std::int64_t num_valid = 0, num_counted = 0, num_runs = 0, num_places = 0;
  for (const float depth_m : data.depth_m) num_valid += depth_m > 0;
  for (const std::vector<PointRun>& band : RunsOf(data, 1)) {
    std::map<Place, std::uint32_t> of_place;
    for (const PointRun& run : band) {
      EXPECT_GT(run.num_points(), 0u);
      EXPECT_EQ(run.weight(), static_cast<float>(run.num_points()));
      of_place[PlaceOf(run)] += run.num_points();
      num_counted += run.num_points();
      ++num_runs;
    }
    num_places += static_cast<std::int64_t>(of_place.size());
  }
  EXPECT_EQ(num_counted, num_valid);
  EXPECT_GE(num_runs, num_places);
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
