// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/point_query.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/unit/server/app/plane_map.h"

namespace dhpmap {
namespace {

using testing::PlaneMap;

TEST(LookUpPoints, AnswersInTheOrderOfThePoints) {
  const MapView view(PlaneMap());
  const std::vector<Eigen::Vector3d> points_m = {{9, 9, 9}, {0.1, 0.1, 0.2}, {0.1, 0.1, 0.1}};
  std::vector<PointInfo> answers;
  ASSERT_TRUE(
      LookUpPoints(view, points_m, {}, InPlace, [&](const PointInfo& point) { answers.push_back(point); }).ok());
  ASSERT_EQ(answers.size(), points_m.size());
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const PointInfo expected = view.lookup().At(points_m[i]);
    EXPECT_EQ(answers[i].is_observed, expected.is_observed) << i;
    EXPECT_EQ(answers[i].distance_m, expected.distance_m) << i;
  }
  EXPECT_FALSE(answers[0].is_observed);
  EXPECT_TRUE(answers[1].is_observed);
}

TEST(LookUpPoints, EndsSoonAfterACancellation) {
  const MapView view(PlaneMap());
  const std::vector<Eigen::Vector3d> points_m(20000, {0.1, 0.1, 0.1});
  std::stop_source caller;
  int num_answered = 0;
  const Status status = LookUpPoints(view, points_m, caller.get_token(), InPlace, [&](const PointInfo&) {
    if (++num_answered == 100) caller.request_stop();
  });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_LT(num_answered, 10000);
}

TEST(LookUpPoints, OfNoPointsIsEmpty) {
  const MapView view(PlaneMap());
  EXPECT_TRUE(LookUpPoints(view, {}, {}, InPlace, [](const PointInfo&) { FAIL(); }).ok());
}

}  // namespace
}  // namespace dhpmap
