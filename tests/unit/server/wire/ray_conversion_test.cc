// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/ray_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "proto/types/resource_names.h"

namespace dhpmap {
namespace {

void Add(google::protobuf::RepeatedField<float>& list, std::initializer_list<float> values) {
  list.Add(values.begin(), values.end());
}

TEST(RaysFromProto, ReadsPackedRaysFirstAndNormalisesDirections) {
  v1::CastRaysRequest request;
  Add(*request.mutable_packed_origins_m(), {1, 2, 3, 4, 5, 6});
  Add(*request.mutable_packed_directions(), {0, 0, 2, 3, 0, 4});
  request.add_rays()->mutable_direction()->set_y(-9);
  const auto rays = RaysFromProto(request, 3);
  ASSERT_TRUE(rays.ok());
  ASSERT_EQ(rays->size(), 3u);
  EXPECT_EQ((*rays)[0].direction, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ((*rays)[1].origin_m, Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(((*rays)[1].direction - Eigen::Vector3d(0.6, 0, 0.8)).norm(), 0, 1e-12);
  EXPECT_EQ((*rays)[2].direction, Eigen::Vector3d(0, -1, 0));
}

TEST(RaysFromProto, OneOriginAppliesToAllRays) {
  v1::CastRaysRequest request;
  Add(*request.mutable_packed_origins_m(), {1, 2, 3});
  Add(*request.mutable_packed_directions(), {1, 0, 0, 0, 1, 0});
  const auto rays = RaysFromProto(request, 2);
  ASSERT_TRUE(rays.ok());
  EXPECT_EQ((*rays)[1].origin_m, Eigen::Vector3d(1, 2, 3));
}

TEST(RaysFromProto, NamesTheFirstViolation) {
  struct Case {
    std::function<void(v1::CastRaysRequest&)> fill;
    const char* field;
    const char* what;
  };
  const Case cases[] = {
      {[](auto& r) {
         Add(*r.mutable_packed_directions(), {1, 0});
       },
       "packed_directions", "has 2 values, not three a ray"},
      {[](auto& r) {
         Add(*r.mutable_packed_directions(), {1, 0, 0});
       },
       "packed_origins_m", "has 0 values"},
      {[](auto& r) {
         Add(*r.mutable_packed_origins_m(), {1, 0, 0});
       },
       "packed_origins_m", "has 3 values"},
      {[](auto& r) {
         Add(*r.mutable_packed_origins_m(), {0, 0, 0});
         Add(*r.mutable_packed_directions(), {1, 0, 0, 0, 0, 0});
       },
       "packed_directions", "ray 1 is not finite or has no direction"},
      {[](auto& r) {
         Add(*r.mutable_packed_origins_m(), {0, std::nanf(""), 0});
         Add(*r.mutable_packed_directions(), {1, 0, 0});
       },
       "packed_directions", "ray 0"},
      {[](auto& r) { r.add_rays()->mutable_direction()->set_x(INFINITY); }, "rays[0]", "is not finite"},
      {[](auto& r) { r.add_rays()->mutable_direction()->set_x(1e300); }, "rays[0]", "is not finite"},
      {[](auto& r) { r.add_rays()->mutable_origin_m()->set_x(1); }, "rays[0]", "has no direction"},
      {[](auto& r) {
         for (int i = 0; i < 4; ++i) r.add_rays()->mutable_direction()->set_x(1);
       },
       "packed_directions", "4 rays are more than 3"},
  };
  for (const Case& c : cases) {
    v1::CastRaysRequest request;
    c.fill(request);
    const Status status = RaysFromProto(request, 3).status();
    EXPECT_EQ(status.reason(), Reason("BAD_POINTS")) << c.what;
    ASSERT_EQ(status.violations().size(), 1u) << c.what;
    EXPECT_EQ(status.violations()[0].field, c.field);
    EXPECT_NE(status.violations()[0].description.find(c.what), std::string::npos) << status.ToString();
  }
}

class RayAnswersTest : public ::testing::Test {
 protected:
  RayAnswersTest() {
    map.name = "home";
    map.revision = 5;
    map.label_set = std::make_shared<const LabelSet>(*LabelSet::Create({{.id = ClassId(2), .name = "chair"}}));
    nothing.point_m.setConstant(std::numeric_limits<double>::quiet_NaN());
    nothing.normal = nothing.point_m;
  }
  MapInfo map;
  const SubmapInfo info = {.id = SubmapId(3), .panoptic = Panoptic::kThing, .class_id = ClassId(2)};
  const RayHit chair = {.submap = &info, .distance_m = 2, .point_m = {1, 2, 3}, .normal = {0, 0, 1}, .free_m = 2};
  const RayHit behind_unseen = {
      .submap = &info, .distance_m = 2, .point_m = {1, 2, 3}, .normal = {0, 0, 1}, .is_unknown = true, .free_m = 0.5};
  RayHit nothing = {.distance_m = 3, .free_m = 3};
  v1::CastRaysRequest request;
  v1::CastRaysResponse response;
};

TEST_F(RayAnswersTest, AreMessagesInReadableForm) {
  RayAnswers answers(request, map, response);
  for (const RayHit& hit : {chair, behind_unseen, nothing}) answers.Append(hit);
  EXPECT_EQ(response.revision(), 5);
  ASSERT_EQ(response.results_size(), 3);
  EXPECT_EQ(response.results(0).status(), v1::QueryStatus::OK);
  EXPECT_EQ(response.results(0).point_m().y(), 2);
  EXPECT_EQ(response.results(0).normal().z(), 1);
  EXPECT_EQ(response.results(0).submap(), "maps/home/submaps/3");
  EXPECT_EQ(response.results(0).class_name(), "chair");
  EXPECT_EQ(response.results(1).status(), v1::QueryStatus::UNKNOWN);
  EXPECT_EQ(response.results(1).free_distance_m(), 0.5f);
  EXPECT_EQ(response.results(1).instance_id(), 3);
  EXPECT_EQ(response.results(2).status(), v1::QueryStatus::CLAMPED);
  EXPECT_EQ(response.results(2).distance_m(), 3);
  EXPECT_EQ(response.results(2).instance_id(), -1);
  EXPECT_FALSE(response.results(2).has_point_m() || response.results(2).has_normal());
}

TEST_F(RayAnswersTest, AreColumnsInPackedForm) {
  request.set_packed(true);
  RayAnswers answers(request, map, response);
  for (const RayHit& hit : {chair, behind_unseen, nothing}) answers.Append(hit);
  const v1::PackedRayResults& packed = response.packed();
  ASSERT_EQ(packed.point_m_size(), 9);
  ASSERT_EQ(packed.normal_size(), 9);
  EXPECT_EQ(packed.distance_m(0), 2);
  EXPECT_EQ(packed.free_distance_m(1), 0.5f);
  EXPECT_TRUE(std::isnan(packed.point_m(6)) && std::isnan(packed.normal(8)));
  EXPECT_EQ(packed.instance_id(2), -1);
  EXPECT_EQ(packed.class_id(0), 2);
  EXPECT_EQ(packed.class_id(2), kNoClass);
  EXPECT_EQ(packed.status(1), v1::QueryStatus::UNKNOWN);
  EXPECT_EQ(packed.status(2), v1::QueryStatus::CLAMPED);
}

TEST_F(RayAnswersTest, StayWithinTheEstimatedMemory) {
  constexpr int kRays = 10000;
  for (const bool is_packed : {false, true}) {
    request.set_packed(is_packed);
    request.mutable_packed_directions()->Resize(3 * kRays, 0);
    v1::CastRaysResponse fresh;
    RayAnswers answers(request, map, fresh);
    for (int i = 0; i < kRays; ++i) answers.Append(behind_unseen);
    EXPECT_LE(48 * kRays + fresh.SpaceUsedLong() + fresh.ByteSizeLong(), BytesOfAnswers(request)) << is_packed;
  }
}

}  // namespace
}  // namespace dhpmap
