// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/surface_keeper.h"

#include <gtest/gtest.h>

#include <atomic>

#include "mapping/query/distance_query.h"
#include "tests/support/eventually.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

class SurfaceKeeperTest : public ::testing::Test {
 protected:
  /// Queries near the ball only.
  double Ask() { return Ask(cache_); }
  double Ask(SurfaceCache& cache) {
    return DistanceQuery(cache.Of(map_.published()), {.max_distance_m = 0.2}).At({0.45, 0, 0}).distance_m;
  }
  void Grow(double by_m) {
    const auto ball = testing::Ball({0, 0, 0}, 0.3 + by_m);
    testing::ObserveBand(*map_.FindMutable(SubmapId(1)), ball, testing::CubeAt({0, 0, 0}, 0.5));
    map_.Publish(0);
  }
  void SetUp() override {
    testing::ObserveBand(testing::AddThing(map_), testing::Ball({0, 0, 0}, 0.3), testing::CubeAt({0, 0, 0}, 0.5));
    testing::ObserveBand(testing::AddThing(map_), testing::Ball({9, 0, 0}, 0.3), testing::CubeAt({9, 0, 0}, 0.5));
    map_.Publish(0);
  }

  Map map_{testing::SceneInfo()};
  SurfaceCache cache_{std::size_t{1} << 30};
};

TEST_F(SurfaceKeeperTest, RefreshesRequestedSurfacesAheadOfTheNextQuery) {
  SurfaceKeeper keeper(cache_);
  (void)Ask();
  const std::size_t of_one_ball = cache_.bytes();
  const auto before = map_.published();  // so that the old surfaces stay, too
  const auto old = cache_.Of(before);
  Grow(0.02);
  keeper.Note(map_.published());
  SurfaceCache other(std::size_t{1} << 30);
  const double distance_m = Ask(other);
  const std::size_t ready = of_one_ball + other.bytes();
  EXPECT_TRUE(testing::Eventually([&] { return cache_.bytes() >= ready; })) << cache_.bytes() << " of " << ready;
  EXPECT_EQ(Ask(), distance_m);
  keeper.Stop();
  EXPECT_EQ(cache_.bytes(), ready) << "nothing else was made, by either";
}

TEST_F(SurfaceKeeperTest, ReportsWhenAllRequestedSurfacesAreMade) {
  SurfaceKeeper keeper(cache_);
  std::atomic<int> num_ready = 0;
  EXPECT_FALSE(keeper.Note(map_.published(), [&] { ++num_ready; })) << "nobody has asked";
  for (int i = 1; i <= 3; ++i) {
    (void)Ask();
    Grow(0.01 * i);
    EXPECT_TRUE(keeper.Note(map_.published(), [&] { ++num_ready; }));
    ASSERT_TRUE(testing::Eventually([&] { return num_ready == i; }));
    const std::size_t ready_bytes = cache_.bytes();
    (void)Ask();
    EXPECT_EQ(cache_.bytes(), ready_bytes) << "there was nothing left to make";
  }
  keeper.Stop();
  EXPECT_FALSE(keeper.Note(map_.published(), [&] { ++num_ready; }));
  EXPECT_EQ(num_ready, 3);
}

TEST_F(SurfaceKeeperTest, MakesNoSurfacesOfUnqueriedMaps) {
  SurfaceKeeper keeper(cache_);
  for (int i = 0; i < 20; ++i) {
    Grow(0.001 * i);
    keeper.Note(map_.published());
  }
  keeper.Stop();
  EXPECT_EQ(cache_.bytes() + cache_.num_tiles(), 0u);
}

TEST_F(SurfaceKeeperTest, StopsAtAnyTimeAndIgnoresLaterStates) {
  for (int round = 0; round < 30; ++round) {
    SurfaceKeeper keeper(cache_);
    for (int i = 0; i < round % 4; ++i) {
      (void)Ask();
      Grow(0.001 * (round + i));
      keeper.Note(map_.published());
    }
    keeper.Stop();
    Grow(0.05);
    keeper.Note(map_.published());
  }
  const std::weak_ptr<const MapSnapshot> state = map_.published();
  Grow(0.01);
  EXPECT_TRUE(state.expired()) << "nobody keeps it";
}

}  // namespace
}  // namespace dhpmap
