// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/nearby_cells.h"

#include <gtest/gtest.h>

#include <cstring>

#include "mapping/query/distance_query.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kPlenty;

constexpr int kTimesACell = 6;  // more often than a cell must be asked for to be made

/// The same bits, though NaN.
void ExpectSame(const SurfaceDistance& a, const SurfaceDistance& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.gradient, b.gradient);
  EXPECT_EQ(std::memcmp(a.nearest_m.data(), b.nearest_m.data(), sizeof(a.nearest_m)), 0);
  EXPECT_EQ(a.submap, b.submap);
}

void ExpectCellsChangeNothing(Map& map, const DistanceOptions& options, double half_m) {
  const auto state = map.Publish(0);
  const auto points = testing::RandomPoints(500, half_m, 31);
  SurfaceCache cache(kPlenty), reference(kPlenty);
  const DistanceQuery query(cache.Of(state), options), once(reference.Of(state), options);
  std::vector<SurfaceDistance> batch(points.size());
  for (int n = 0; n < kTimesACell; ++n) query.At(points, batch);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfaceDistance before = once.At(points[i]);  // most cells are never made
    ExpectSame(before, batch[i]);
    ExpectSame(before, query.At(points[i]));
  }
  EXPECT_GT(cache.cell_bytes(), reference.cell_bytes());
}

TEST(NearbyCells, ChangeNoBitOfAnAnswer) {
  Map map = testing::DisarrayedRoom(3);
  ExpectCellsChangeNothing(map, {}, 1.9);
  ExpectCellsChangeNothing(map, {.max_distance_m = 0.2}, 1.9);
}

TEST(NearbyCells, ServeWhateverIsExcluded) {
  Map map = testing::DisarrayedRoom(4);
  DistanceOptions options;
  options.scope.excluded_submaps = {SubmapId(4), SubmapId(2)};  // the room, so that much is far
  ExpectCellsChangeNothing(map, options, 1.9);
  options.scope = {.classes = std::vector<ClassId>{ClassId(2)}};
  ExpectCellsChangeNothing(map, options, 1.9);
}

TEST(NearbyCells, ServeLimitsBeyondTheirReach) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.3), testing::CubeAt({0, 0, 0}, 0.5));
  ExpectCellsChangeNothing(map, {.max_distance_m = 9}, 4.5);
}

TEST(NearbyCells, MadeForSomeServeOthersWithAnotherScope) {
  Map map = testing::DisarrayedRoom(5);
  const auto state = map.Publish(0);
  const auto points = testing::RandomPoints(300, 1.9, 7);
  SurfaceCache cache(kPlenty), reference(kPlenty);
  DistanceOptions narrow;
  narrow.scope.excluded_submaps = {SubmapId(1), SubmapId(4)};
  std::vector<SurfaceDistance> answers(points.size());
  for (int n = 0; n < kTimesACell; ++n) DistanceQuery(cache.Of(state), narrow).At(points, answers);
  const DistanceQuery wide(cache.Of(state), {}), truth(reference.Of(state), {});
  for (const Eigen::Vector3d& p : points) ExpectSame(wide.At(p), truth.At(p));
}

TEST(NearbyCells, GiveTheirBytesBackOnceTheNextStateHasANextOne) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  {
    const DistanceQuery query(cache.Of(map.Publish(0)), {});
    for (int n = 0; n < kTimesACell; ++n) (void)query.At({0.1, 0.2, 0.3});
    EXPECT_GT(cache.cell_bytes(), 0u);
  }
  std::vector<std::size_t> of_next;
  for (int n = 1; n < 5; ++n) {
    (void)map.FindMutable(SubmapId(1));
    of_next.push_back((cache.Of(map.Publish(n)), cache.cell_bytes()));
  }
  SurfaceCache fresh(kPlenty);
  (void)fresh.Of(map.published());
  EXPECT_LT(of_next[1], of_next[0]) << "which may take over what the first had";
  EXPECT_LT(of_next[1], 2 * fresh.cell_bytes()) << "none of the two has a cell";
  EXPECT_EQ(of_next[3], of_next[1]);
}

TEST(NearbyCells, AreNotMadeWhereTheMapIsBeyondMeasure) {
  Map map(testing::SceneInfo());
  Transform far = Transform::Identity();
  far.translation() = Eigen::Vector3d(4e6, -3e6, 1e6);
  for (const Transform& T : {Transform::Identity(), far}) {
    testing::ObserveBand(testing::AddThing(map, ClassId(1), T), testing::Ball({0, 0, 0}, 0.3),
                         testing::CubeAt({0, 0, 0}, 0.5));
  }
  SurfaceCache cache(kPlenty);
  const DistanceQuery query(cache.Of(map.Publish(0)), {});
  for (int n = 0; n < kTimesACell; ++n)
    EXPECT_NEAR(query.At({0.7, 0, 0}).distance_m, 0.4, 0.1 * testing::kSceneVoxel_m);
  EXPECT_EQ(cache.cell_bytes(), 0u);
}

TEST(NearestSearch, TellsWhetherAnythingIsCloserThanARadius) {
  Map map = testing::DisarrayedRoom(6);
  SurfaceCache cache(kPlenty);
  DistanceOptions options{.max_distance_m = 9};
  options.scope.excluded_submaps = {SubmapId(3)};
  const DistanceQuery query(cache.Of(map.Publish(0)), options);
  int num_any = 0;
  for (int n = 0; n < kTimesACell; ++n) {
    for (const Eigen::Vector3d& p : testing::RandomPoints(300, 1.9, 8)) {
      const double distance_m = std::abs(query.At(p).distance_m);
      for (const double radius_m : {0.0, 0.05, 0.3, 1.0, 5.0, 0.99 * distance_m, 1.01 * distance_m}) {
        EXPECT_EQ(query.AnyCloserThan(p, radius_m), distance_m <= radius_m) << distance_m;
        num_any += distance_m <= radius_m;
      }
    }
  }
  EXPECT_GT(num_any, 3000);
}

}  // namespace
}  // namespace dhpmap
