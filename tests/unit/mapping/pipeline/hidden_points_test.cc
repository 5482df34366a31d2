// SPDX-License-Identifier: BSD-3-Clause
// What becomes of LiDAR points that the camera, which labelled them, does not see.
#include <gtest/gtest.h>

#include "mapping/pipeline/map_builder.h"
#include "mapping/query/point_lookup.h"
#include "tests/support/map_equality.h"
#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

constexpr ClassId kCarClass{1}, kWallClass{3};
constexpr std::uint32_t kCarId = 4, kWallId = 9;

/// A car's side at x = 5 m and two walls at x = 9: the left one has the car's id, the right one its own.
PanopticFrame StreetScan(bool with_flags) {
  PanopticFrame frame;
  frame.segments = {{SegmentId(kCarId), kCarClass}, {SegmentId(kWallId), kWallClass}};
  LidarData& scan = frame.lidar.emplace();
  const auto add_plate = [&scan](float x, float y0, float y1, std::uint32_t id, bool is_hidden) {
    for (float y = y0; y < y1; y += 0.05f) {
      for (float z = -0.5f; z < 0.5f; z += 0.05f) {
        scan.points_m.emplace_back(x, y, z);
        scan.segments.push_back(id);
        scan.is_hidden.push_back(is_hidden);
      }
    }
  };
  add_plate(5, -1, 1, kCarId, false);
  add_plate(9, 3, 5, kCarId, true);
  add_plate(9, -5, -3, kWallId, true);
  if (!with_flags) scan.is_hidden.clear();
  return frame;
}

MapInfo StreetInfo() {
  MapInfo info = testing::NamedMap("street", 2, 1);
  info.config = OutdoorLidarConfig();
  info.config.tracking.min_points_stuff = info.config.tracking.min_points_medium = 10;
  return info;
}

std::shared_ptr<const MapSnapshot> MapOf(const PanopticFrame& frame) {
  MapBuilder builder(StreetInfo(), 1);
  EXPECT_TRUE(builder.Integrate(frame).ok());
  return builder.map().Publish(0);
}

TEST(HiddenPoints, OfAThingLoseTheirLabelAndKeepTheirSurface) {
  const PointLookup lookup(MapOf(StreetScan(true)));
  const PointInfo car = lookup.At({5, 0, 0}), behind = lookup.At({9, 4, 0});
  ASSERT_TRUE(car.is_observed);
  EXPECT_EQ(car.class_id, kCarClass);
  ASSERT_TRUE(behind.is_observed);
  EXPECT_EQ(behind.submap, kUnknownSubmap);
  EXPECT_NEAR(behind.distance_m, 0, 0.1);
}

TEST(HiddenPoints, OfStuffKeepTheirLabel) {
  const PointInfo wall = PointLookup(MapOf(StreetScan(true))).At({9, -4, 0});
  ASSERT_TRUE(wall.is_observed);
  EXPECT_EQ(wall.class_id, kWallClass);
}

TEST(HiddenPoints, WithoutFlagsEveryLabelCounts) {
  EXPECT_EQ(PointLookup(MapOf(StreetScan(false))).At({9, 4, 0}).class_id, kCarClass);
}

TEST(HiddenPoints, AreMappedLikePointsOfNoSegment) {
  PanopticFrame relabelled = StreetScan(true);
  for (std::size_t i = 0; i < relabelled.lidar->segments.size(); ++i) {
    if (relabelled.lidar->is_hidden[i] != 0 && relabelled.lidar->segments[i] == kCarId) {
      relabelled.lidar->segments[i] = 0;
    }
  }
  relabelled.lidar->is_hidden.clear();
  EXPECT_TRUE(testing::MapsAreEqual(*MapOf(StreetScan(true)), *MapOf(relabelled)));
}

}  // namespace
}  // namespace dhpmap
