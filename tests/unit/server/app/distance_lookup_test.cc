// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/distance_lookup.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/unit/server/app/plane_map.h"

namespace dhpmap {
namespace {

using testing::PlaneMap;

TEST(LookUpDistances, AnswersInTheOrderOfThePoints) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  const std::vector<Eigen::Vector3d> points_m = {{9, 9, 9}, {0.1, 0.1, 0.7}, {0.1, 0.1, 0.1}};
  std::vector<SurfaceDistance> answers;
  ASSERT_TRUE(LookUpDistances(view, cache, {}, points_m, {}, InPlace, [&](const SurfaceDistance& d) {
                answers.push_back(d);
              }).ok());
  ASSERT_EQ(answers.size(), points_m.size());
  EXPECT_EQ(answers[0].status, DistanceStatus::kClamped);
  EXPECT_NEAR(answers[1].distance_m, 0.5, 1e-3);
  EXPECT_NEAR(answers[2].distance_m, -0.1, 1e-3);
}

TEST(LookUpDistances, AnswersInTheQueryFrame) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  DistanceQuestion question;
  question.T_map_query.translate(Eigen::Vector3d(1, 2, 3));
  question.T_map_query.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 1).normalized()));
  const Transform T_query_map = question.T_map_query.inverse();
  const std::vector<Eigen::Vector3d> points_m = {T_query_map * Eigen::Vector3d(0.1, 0.1, 0.7)};
  ASSERT_TRUE(LookUpDistances(view, cache, question, points_m, {}, InPlace, [&](const SurfaceDistance& d) {
                EXPECT_NEAR(d.distance_m, 0.5, 1e-3);
                EXPECT_NEAR((d.nearest_m - T_query_map * Eigen::Vector3d(0.1, 0.1, 0.2)).norm(), 0, 1e-3);
                EXPECT_NEAR((d.gradient - T_query_map.linear() * Eigen::Vector3d::UnitZ()).norm(), 0, 1e-3);
              }).ok());
}

TEST(LookUpDistances, EndsSoonAfterACancellation) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  const std::vector<Eigen::Vector3d> points_m(20000, {0.1, 0.1, 0.1});
  std::stop_source caller;
  int num_answered = 0;
  const Status status =
      LookUpDistances(view, cache, {}, points_m, caller.get_token(), InPlace, [&](const SurfaceDistance&) {
        if (++num_answered == 100) caller.request_stop();
      });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_LT(num_answered, 10000);
}

TEST(LookUpDistances, OfNoPointsIsEmpty) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  EXPECT_TRUE(LookUpDistances(view, cache, {}, {}, {}, InPlace, [](const SurfaceDistance&) { FAIL(); }).ok());
}

}  // namespace
}  // namespace dhpmap
