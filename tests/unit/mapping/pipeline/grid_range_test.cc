// SPDX-License-Identifier: BSD-3-Clause
// Positions that the grid cannot hold are refused before anything is touched.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "mapping/base/grid_reach.h"
#include "mapping/pipeline/map_builder.h"
#include "tests/support/map_equality.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::MapsAreEqual;

MapInfo WallInfo(double voxel_size_m = 0.04) {
  MapInfo info = testing::NamedMap("m", 1, 1);
  info.config.voxel_size_m = voxel_size_m;
  info.config.truncation_m = 2 * voxel_size_m;
  return info;
}

/// A wall one metre before a sensor at `p_map`.
PanopticFrame WallFrom(const Eigen::Vector3d& p_map) {
  PanopticFrame frame;
  frame.T_map_sensor.translation() = p_map;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = testing::SmallCamera();
  data.depth_m.assign(static_cast<std::size_t>(data.camera.num_pixels()), 1.0f);
  return frame;
}

/// The largest coordinate of any block, in metres.
double Extent_m(const Map& map) {
  double extent_m = 0;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      extent_m = std::max(extent_m, BlockCorner(entry.index, submap->info().voxel_size_m).cwiseAbs().maxCoeff());
    }
  }
  return extent_m;
}

void ExpectRefused(MapBuilder& builder, const PanopticFrame& frame) {
  const auto before = builder.map().Publish(0);
  const auto report = builder.Integrate(frame);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.status().code(), StatusCode::kInvalidArgument);
  ASSERT_EQ(report.status().violations().size(), 1u) << report.status().ToString();
  EXPECT_EQ(report.status().violations()[0].field, "map_from_sensor");
  EXPECT_NE(report.status().violations()[0].description.find("local frame"), std::string::npos);
  EXPECT_EQ(builder.map().Publish(1), before) << "something was touched";
}

TEST(GridRange, AFrameAMillionKilometresAwayIsRefused) {
  MapBuilder builder(WallInfo(), 1);
  ASSERT_TRUE(builder.Integrate(WallFrom({0, 0, 0})).ok());
  for (const double x_m : {1e9, -1e9, 1e308, std::numeric_limits<double>::max()}) {
    ExpectRefused(builder, WallFrom({x_m, 0, 0}));
  }
}

TEST(GridRange, AUtmNorthingIsRefusedAtVoxelsOf2Mm) {
  MapBuilder builder(WallInfo(0.002), 1);
  ExpectRefused(builder, WallFrom({0, 5.4e6, 0}));
}

TEST(GridRange, AUtmNorthingIsMappedWhereItIsAtVoxelsOf4Cm) {
  MapBuilder builder(WallInfo(), 1);
  ASSERT_TRUE(builder.Integrate(WallFrom({6.9e5, 5.4e6, 0})).ok());
  EXPECT_NEAR(Extent_m(builder.map()), 5.4e6, 5);
}

TEST(GridRange, ALidarBeyondTheGridIsRefused) {
  MapBuilder builder(WallInfo(), 1);
  PanopticFrame frame;
  frame.T_map_sensor.translation() = Eigen::Vector3d(0, 0, 1e9);
  frame.lidar.emplace().points_m = {{1, 2, 3}};
  ExpectRefused(builder, frame);
}

TEST(GridRange, DepthsNearerThanAMillimetreAreNoMeasurement) {
  for (const Weighting weighting : {Weighting::kInverseDepthSquared, Weighting::kInverseRangeSquared}) {
    MapInfo info = WallInfo();
    info.config.integration.min_range_m = 0;
    info.config.integration.weighting = weighting;
    MapBuilder builder(info, 1);
    PanopticFrame frame = WallFrom({0, 0, 0});
    for (std::size_t i = 0; i < frame.camera->depth_m.size(); i += 2) frame.camera->depth_m[i] = 1e-38f;
    const auto report = builder.Integrate(frame);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->num_points, static_cast<std::int64_t>(frame.camera->depth_m.size() / 2));
    EXPECT_LT(Extent_m(builder.map()), 3);

    frame.camera.reset();
    frame.lidar.emplace().points_m = {{1e-30f, 0, 0}, {0, 1, 1}};
    const auto scan = builder.Integrate(frame);
    ASSERT_TRUE(scan.ok());
    EXPECT_EQ(scan->num_points, 1);
    EXPECT_LT(Extent_m(builder.map()), 3);
  }
}

TEST(GridRange, ASensorAtTheVeryEdgeMapsWhatItSees) {
  const double edge_m = GridReach_m(0.04);
  MapBuilder builder(WallInfo(), 1);
  ASSERT_TRUE(builder.Integrate(WallFrom({-edge_m, edge_m, edge_m})).ok());
  EXPECT_NEAR(Extent_m(builder.map()), edge_m, 5);
}

TEST(GridRange, TheLongestRayOfTheFinestGridIsWhatTheReachAllowsFor) {
  MapConfig config;
  config.voxel_size_m = 1e-3;
  config.truncation_m = 2e-3;
  config.integration.max_range_m = 1e4;
  ASSERT_TRUE(config.Validate().ok());
  EXPECT_LE(config.integration.max_range_m / config.voxel_size_m, 1e7 + 1);
  config.integration.max_range_m *= 1.01;
  EXPECT_FALSE(config.Validate().ok()) << "longer rays need another look at kGridReach_vox";
  config.integration.max_range_m = 1e4;
  config.voxel_size_m = 0.99e-3;
  EXPECT_FALSE(config.Validate().ok()) << "finer grids, too";
}

}  // namespace
}  // namespace dhpmap
