// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/distance_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "proto/types/resource_names.h"
#include "tests/unit/server/wire/map_of_chairs.h"

namespace dhpmap {
namespace {

using testing::MapOfChairs;

SurfaceDistance Clamped() {
  SurfaceDistance answer{.distance_m = 3};
  answer.nearest_m.setConstant(std::numeric_limits<double>::quiet_NaN());
  return answer;
}

class DistanceAnswersTest : public ::testing::Test {
 protected:
  SurfaceDistance At(const SubmapInfo& submap, DistanceStatus status) const {
    return {.status = status, .distance_m = -0.5, .gradient = {0, 0, 1}, .nearest_m = {1, 2, 3}, .submap = &submap};
  }
  const MapInfo map = MapOfChairs();
  const SubmapInfo chair = {.id = SubmapId(3), .panoptic = Panoptic::kThing, .class_id = ClassId(2)};
  const SubmapInfo unknown = {.id = kUnknownSubmap, .panoptic = Panoptic::kUnknown, .class_id = ClassId(2)};
  v1::QueryDistancesRequest request;
  v1::QueryDistancesResponse response;
};

TEST_F(DistanceAnswersTest, AreMessagesInReadableForm) {
  DistanceAnswers answers(request, map, 3, response);
  answers.Append(At(chair, DistanceStatus::kOk));
  answers.Append(At(unknown, DistanceStatus::kUnknown));
  answers.Append(Clamped());
  EXPECT_EQ(response.revision(), 5);
  EXPECT_FALSE(response.has_packed());
  ASSERT_EQ(response.results_size(), 3);
  EXPECT_EQ(response.results(0).status(), v1::QueryStatus::OK);
  EXPECT_EQ(response.results(0).distance_m(), -0.5f);
  EXPECT_EQ(response.results(0).gradient().z(), 1);
  EXPECT_EQ(response.results(0).nearest_point_m().y(), 2);
  EXPECT_EQ(response.results(0).instance_id(), 3);
  EXPECT_EQ(response.results(0).submap(), "maps/home/submaps/3");
  EXPECT_EQ(response.results(0).class_name(), "chair");
  EXPECT_EQ(response.results(1).status(), v1::QueryStatus::UNKNOWN);
  EXPECT_EQ(response.results(1).instance_id(), 0);
  EXPECT_EQ(response.results(1).class_name(), "") << "unknown objects have no class";
  EXPECT_EQ(response.results(2).status(), v1::QueryStatus::CLAMPED);
  EXPECT_EQ(response.results(2).distance_m(), 3);
  EXPECT_EQ(response.results(2).instance_id(), -1);
  EXPECT_FALSE(response.results(2).has_gradient() || response.results(2).has_nearest_point_m());
}

TEST_F(DistanceAnswersTest, AreColumnsInPackedForm) {
  request.set_packed(true);
  DistanceAnswers answers(request, map, 3, response);
  answers.Append(At(chair, DistanceStatus::kUnknown));
  answers.Append(Clamped());
  answers.Append(At(unknown, DistanceStatus::kOk));
  EXPECT_EQ(response.results_size(), 0);
  const v1::PackedDistanceResults& packed = response.packed();
  ASSERT_EQ(packed.gradient_size(), 9);
  ASSERT_EQ(packed.nearest_point_m_size(), 9);
  EXPECT_EQ(packed.distance_m(0), -0.5f);
  EXPECT_EQ(packed.distance_m(1), 3);
  EXPECT_EQ(packed.gradient(2), 1);
  EXPECT_EQ(packed.gradient(5), 0);
  EXPECT_EQ(packed.nearest_point_m(1), 2);
  EXPECT_TRUE(std::isnan(packed.nearest_point_m(3)));
  EXPECT_EQ(packed.instance_id(0), 3);
  EXPECT_EQ(packed.instance_id(1), -1);
  EXPECT_EQ(packed.instance_id(2), 0);
  EXPECT_EQ(packed.class_id(0), 2);
  EXPECT_EQ(packed.class_id(1), kNoClass);
  EXPECT_EQ(packed.class_id(2), kNoClass);
  EXPECT_EQ(packed.status(0), v1::QueryStatus::UNKNOWN);
  EXPECT_EQ(packed.status(1), v1::QueryStatus::CLAMPED);
  EXPECT_EQ(packed.status(2), v1::QueryStatus::OK);
}

TEST_F(DistanceAnswersTest, StayWithinTheEstimatedMemory) {
  constexpr int kPoints = 10000;
  for (const bool is_packed : {false, true}) {
    request.set_packed(is_packed);
    request.mutable_packed_points_m()->Resize(3 * kPoints, 0);
    v1::QueryDistancesResponse fresh;
    DistanceAnswers answers(request, map, kPoints, fresh);
    for (int i = 0; i < kPoints; ++i) answers.Append(At(chair, DistanceStatus::kUnknown));
    EXPECT_LE(24 * kPoints + fresh.SpaceUsedLong() + fresh.ByteSizeLong(), BytesOfAnswers(request)) << is_packed;
  }
}

}  // namespace
}  // namespace dhpmap
