// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/ray_cast.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/unit/server/app/plane_map.h"

namespace dhpmap {
namespace {

using testing::PlaneMap;

TEST(CastRays, AnswersInTheOrderOfTheRaysAndInTheQueryFrame) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  DistanceQuestion question;
  question.T_map_query.translate(Eigen::Vector3d(1, 2, 3));
  question.T_map_query.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 1).normalized()));
  const Transform T_query_map = question.T_map_query.inverse();
  const auto in_frame = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    return Ray{T_query_map * origin, T_query_map.linear() * direction};
  };
  const std::vector<Ray> rays = {in_frame({0.1, 0.1, 0.7}, {0, 0, -1}), in_frame({0.1, 0.1, 0.7}, {0, 0, 1})};
  std::vector<RayHit> hits;
  ASSERT_TRUE(CastRays(view, cache, question, rays, {}, [&](const RayHit& hit) { hits.push_back(hit); }).ok());
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].distance_m, 0.5, 1e-3);
  EXPECT_NEAR((hits[0].point_m - T_query_map * Eigen::Vector3d(0.1, 0.1, 0.2)).norm(), 0, 1e-3);
  EXPECT_NEAR((hits[0].normal - T_query_map.linear() * Eigen::Vector3d::UnitZ()).norm(), 0, 1e-3);
  EXPECT_EQ(hits[1].submap, nullptr);
}

TEST(CastRays, EndsSoonAfterACancellation) {
  const MapView view(PlaneMap());
  SurfaceCache cache(1 << 20);
  const std::vector<Ray> rays(5000, Ray{{0.1, 0.1, 0.7}, {0, 0, -1}});
  std::stop_source caller;
  int num_answered = 0;
  const Status status = CastRays(view, cache, {}, rays, caller.get_token(), [&](const RayHit&) {
    if (++num_answered == 100) caller.request_stop();
  });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_LT(num_answered, 3000);
}

}  // namespace
}  // namespace dhpmap
