// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/point_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "tests/unit/server/wire/map_of_chairs.h"

namespace dhpmap {
namespace {

using testing::MapOfChairs;

PointInfo Chair() {
  return {.is_observed = true,
          .submap = SubmapId(3),
          .panoptic = Panoptic::kThing,
          .class_id = ClassId(2),
          .distance_m = 0.25f,
          .weight = 4,
          .color = {1, 2, 3},
          .class_confidence = 0.5f,
          .instance_confidence = 0.75f};
}

TEST(PointsFromProto, ReadsPackedPointsFirst) {
  v1::QueryPointsRequest request;
  for (const float value : {1.f, 2.f, 3.f}) request.add_packed_points_m(value);
  request.add_points_m()->set_y(7);
  const auto points_m = PointsFromProto(request, 2);
  ASSERT_TRUE(points_m.ok());
  EXPECT_EQ(*points_m, (std::vector<Eigen::Vector3d>{{1, 2, 3}, {0, 7, 0}}));
}

TEST(PointsFromProto, NamesTheFirstViolation) {
  const auto violation = [](const v1::QueryPointsRequest& request, std::int64_t max_points) {
    const Status status = PointsFromProto(request, max_points).status();
    EXPECT_EQ(status.reason(), Reason("BAD_POINTS"));
    return std::pair(status.violations().at(0).field, status.violations().at(0).description);
  };
  v1::QueryPointsRequest request;
  for (int i = 0; i < 7; ++i) request.add_packed_points_m(0);
  EXPECT_EQ(violation(request, 9),
            std::pair(std::string("packed_points_m"), std::string("has 7 values, not three a point")));
  request.add_packed_points_m(0), request.add_packed_points_m(std::nanf(""));
  EXPECT_EQ(violation(request, 2), std::pair(std::string("packed_points_m"), std::string("3 points are more than 2")));
  EXPECT_EQ(violation(request, 3), std::pair(std::string("packed_points_m"), std::string("point 2 is not finite")));
  request.clear_packed_points_m();
  request.add_points_m();
  request.add_points_m()->set_z(INFINITY);
  EXPECT_EQ(violation(request, 3), std::pair(std::string("points_m[1]"), std::string("is not finite")));
}

TEST(PointAnswers, AreMessagesOrColumnsAsRequested) {
  const MapInfo map = MapOfChairs();
  v1::QueryPointsRequest request;
  v1::QueryPointsResponse response;
  PointAnswers messages(request, map, 2, response);
  messages.Append(Chair());
  messages.Append({});
  EXPECT_EQ(response.revision(), 5);
  ASSERT_EQ(response.results_size(), 2);
  EXPECT_FALSE(response.has_packed());
  EXPECT_EQ(response.results(0).submap(), "maps/home/submaps/3");
  EXPECT_EQ(response.results(0).class_name(), "chair");
  EXPECT_EQ(response.results(0).kind(), v1::LabelClass::THING);
  EXPECT_EQ(response.results(0).color().b(), 3u);
  EXPECT_EQ(response.results(0).class_id(), 2);
  EXPECT_EQ(response.results(1).ByteSizeLong(), 0u) << "nothing is known of it";
  PointInfo wall = Chair();
  wall.class_id = ClassId(0);
  messages.Append(wall);
  EXPECT_TRUE(response.results(2).has_class_id()) << "0 is a class";
  wall.panoptic = Panoptic::kUnknown;
  messages.Append(wall);
  EXPECT_FALSE(response.results(3).has_class_id()) << "it has no class";

  request.set_packed(true);
  response.Clear();
  PointAnswers arrays(request, map, 3, response);
  arrays.Append(Chair());
  arrays.Append({});
  PointInfo stale = Chair();
  stale.is_observed = false;
  arrays.Append(stale);
  const v1::PackedPointResults& packed = response.packed();
  EXPECT_EQ(response.results_size(), 0);
  ASSERT_EQ(packed.near_surface_size(), 3);
  EXPECT_EQ(packed.instance_id(0), 3);
  EXPECT_EQ(packed.tsdf_m(0), 0.25f);
  EXPECT_EQ(packed.rgb(), std::string("\1\2\3\0\0\0\0\0\0", 9));
  EXPECT_EQ(packed.kind(), std::string("\1\0\0", 3));
  EXPECT_EQ(packed.instance_id(2), 0) << "of what is not observed nothing else is told";
  EXPECT_TRUE(std::isnan(packed.tsdf_m(1))) << "no distance is not a distance of 0";
  EXPECT_FALSE(packed.free(0) || packed.free(1));
}

TEST(PointAnswers, DistinguishFreeFromUnknownWithoutADistance) {
  const MapInfo map = MapOfChairs();
  for (const bool is_packed : {false, true}) {
    v1::QueryPointsRequest request;
    request.set_packed(is_packed);
    v1::QueryPointsResponse response;
    PointAnswers answers(request, map, 2, response);
    answers.Append({.is_free = true});
    answers.Append({});
    if (is_packed) {
      EXPECT_TRUE(response.packed().free(0));
      EXPECT_FALSE(response.packed().free(1) || response.packed().near_surface(0));
      EXPECT_TRUE(std::isnan(response.packed().tsdf_m(0)));
    } else {
      EXPECT_TRUE(response.results(0).free());
      EXPECT_FALSE(response.results(1).free() || response.results(0).near_surface());
      EXPECT_FALSE(response.results(0).has_tsdf_m() || response.results(1).has_tsdf_m());
    }
  }
}

TEST(BytesOfAnswers, IsAtLeastTheMemoryOfAnswers) {
  constexpr int kPoints = 1000;
  const MapInfo map = MapOfChairs();
  for (const bool is_packed : {false, true}) {
    v1::QueryPointsRequest request;
    request.set_packed(is_packed);
    for (int i = 0; i < 3 * kPoints; ++i) request.add_packed_points_m(0);
    v1::QueryPointsResponse response;
    PointAnswers answers(request, map, kPoints, response);
    for (int i = 0; i < kPoints; ++i) answers.Append(Chair());
    const std::size_t taken = kPoints * sizeof(Eigen::Vector3d) + response.SpaceUsedLong() + response.ByteSizeLong();
    EXPECT_GE(BytesOfAnswers(request), taken) << (is_packed ? "packed" : "one message a point");
    EXPECT_LE(BytesOfAnswers(request), 2 * taken) << "nor much more";
  }
}

}  // namespace
}  // namespace dhpmap
