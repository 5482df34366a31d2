// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feeds/sensor_path.h"

#include <gtest/gtest.h>

#include "server/app/feeds/feed_tally.h"

namespace dhpmap {
namespace {

Transform At(double x_m) {
  Transform T = Transform::Identity();
  T.translation() = Eigen::Vector3d(x_m, 1, 2);
  return T;
}

TEST(SensorPath, KeepsDistantPlacesAndTheNewestOne) {
  SensorPath path;
  EXPECT_TRUE(path.places_m().empty());
  for (const double x_m : {0.0, 0.01, 0.02, 0.06, 0.07}) path.Add(At(x_m));
  ASSERT_EQ(path.places_m().size(), 3u);
  EXPECT_EQ(path.places_m()[0].x(), 0.0f);
  EXPECT_EQ(path.places_m()[1].x(), 0.06f);
  EXPECT_EQ(path.places_m()[2].x(), 0.07f);
  EXPECT_EQ(path.T_map_sensor().translation(), At(0.07).translation());
}

TEST(SensorPath, OfALongWayIsCoarserWithItsStartAndEnd) {
  SensorPath path;
  for (int i = 0; i < 100'000; ++i) path.Add(At(0.1 * i));
  const auto places_m = path.places_m();
  EXPECT_GE(places_m.size(), SensorPath::kMostPlaces / 2);
  EXPECT_LE(places_m.size(), SensorPath::kMostPlaces);
  EXPECT_EQ(places_m.front().x(), 0.0f);
  EXPECT_FLOAT_EQ(places_m.back().x(), 9999.9f);
  for (std::size_t i = 1; i < places_m.size(); ++i) EXPECT_LT(places_m[i - 1].x(), places_m[i].x());
}

TEST(FeedTally, ReturnsTheSensorsPlaceAfterAFrame) {
  FeedTally tally;
  EXPECT_TRUE(tally.Path().places_m().empty());
  tally.OnFused(1, 7, 1'000'000'000, At(3));
  ASSERT_EQ(tally.Path().places_m().size(), 1u);
  EXPECT_EQ(tally.Path().places_m()[0], Eigen::Vector3f(3, 1, 2));
}

}  // namespace
}  // namespace dhpmap
