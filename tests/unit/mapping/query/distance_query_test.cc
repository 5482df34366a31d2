// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/distance_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::AllTriangles;
using testing::BruteNearest;
using testing::kSceneTruncation_m;
using testing::kSceneVoxel_m;

/// A map's distances as it is now.
DistanceQuery QueryOf(Map& map, DistanceOptions options = {}) {
  SurfaceCache cache(std::size_t{1} << 30);
  return {cache.Of(map.Publish(0)), std::move(options)};
}

void ExpectEqualsBruteForce(Map& map, const DistanceOptions& options, int num_points, double half_m) {
  const DistanceQuery query = QueryOf(map, options);
  const AllTriangles all(*map.published(), [&](const SubmapInfo& info) { return options.scope.Holds(info); });
  const auto points = testing::RandomPoints(num_points, half_m, 17);
  std::vector<SurfaceDistance> batch(points.size());
  query.At(points, batch);
  int num_clamped = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BruteNearest truth = all.Nearest(points[i]);
    const SurfaceDistance single = query.At(points[i]);
    for (const SurfaceDistance& answer : {single, batch[i]}) {
      if (truth.distance_m > options.max_distance_m + 1e-6) {
        EXPECT_EQ(answer.status, DistanceStatus::kClamped);
        EXPECT_EQ(answer.submap, nullptr);
        EXPECT_EQ(answer.distance_m, options.max_distance_m);
        EXPECT_TRUE(answer.gradient.isZero());
        EXPECT_TRUE(answer.nearest_m.hasNaN());
        ++num_clamped;
        continue;
      }
      ASSERT_NE(answer.submap, nullptr) << points[i].transpose();
      EXPECT_NEAR(std::abs(answer.distance_m), truth.distance_m, 0.001 * kSceneVoxel_m);
      EXPECT_NEAR((points[i] - answer.nearest_m).norm(), truth.distance_m, 0.001 * kSceneVoxel_m);
      EXPECT_NEAR(answer.gradient.norm(), 1, 1e-5);
      EXPECT_NEAR((points[i] - answer.distance_m * answer.gradient - answer.nearest_m).norm(), 0, 1e-3 * kSceneVoxel_m);
    }
    EXPECT_EQ(single.status, batch[i].status);
    EXPECT_NEAR(single.distance_m, batch[i].distance_m, 0.001 * kSceneVoxel_m);
  }
  EXPECT_LT(num_clamped, num_points) << "most are to be near";
}

TEST(DistanceQuery, EqualsBruteForceOverAllTriangles) {
  Map map = testing::FurnishedRoom();
  ExpectEqualsBruteForce(map, {}, 120, 1.9);
  ExpectEqualsBruteForce(map, {.max_distance_m = 0.25}, 80, 1.9);
}

TEST(DistanceQuery, EqualsBruteForceWhereObjectsAreMovedTurnedAndCloned) {
  Map map = testing::FurnishedRoom();
  std::mt19937 random(11);
  for (const std::uint32_t id : {1u, 2u, 3u}) {
    map.FindMutable(SubmapId(id))->mutable_info().T_map_submap = testing::RandomPose(random, 0.5);
  }
  for (const std::uint32_t id : {1u, 2u, 0u}) {
    map.Clone(SubmapId(id))->mutable_info().T_map_submap = testing::RandomPose(random, 0.8);
  }
  ExpectEqualsBruteForce(map, {}, 80, 1.9);
}

TEST(DistanceQuery, InOrderEqualsOneByOne) {
  Map map = testing::DisarrayedRoom(5);
  SurfaceCache cache(std::size_t{1} << 30);
  const auto points = testing::RandomPoints(300, 1.7, 19);  // close together or not: that is for speed alone
  for (const double padding_m : {0.0, 0.05}) {
    DistanceOptions options;
    options.scope.padding = {.default_m = 0, .classes = {{ClassId(1), padding_m}}, .submaps = {}};
    const DistanceQuery query(cache.Of(map.Publish(0)), options);
    std::vector<SurfaceDistance> in_order(points.size());
    query.AtInOrder(points, in_order);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const SurfaceDistance one = query.At(points[i]);
      EXPECT_EQ(in_order[i].status, one.status);
      EXPECT_EQ(in_order[i].submap, one.submap);
      EXPECT_NEAR(in_order[i].distance_m, one.distance_m, 1e-4 * kSceneVoxel_m);
    }
    query.AtInOrder({}, {});
  }
}

TEST(DistanceQuery, EqualsBruteForceFarFromTheOrigin) {
  Map map(testing::SceneInfo());
  Transform T = Transform::Identity();
  T.translate(Eigen::Vector3d(-900, 700, 50));
  T.rotate(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 2).normalized()));
  testing::ObserveBand(testing::AddThing(map, ClassId(1), T), testing::Ball({0, 0, 0}, 0.4),
                       testing::CubeAt({0, 0, 0}, 0.6));
  testing::ObserveBand(testing::AddThing(map), testing::Ball({3, 0, 0}, 0.3), testing::CubeAt({3, 0, 0}, 0.5));
  const DistanceQuery query = QueryOf(map);
  for (const Eigen::Vector3d& p : testing::RandomPoints(200, 1.0, 3)) {
    const SurfaceDistance answer = query.At(T * p);
    ASSERT_NE(answer.submap, nullptr);
    EXPECT_NEAR(std::abs(answer.distance_m), std::abs(p.norm() - 0.4), 0.1 * kSceneVoxel_m);
  }
}

TEST(DistanceQuery, EqualsTheScene) {
  // Distance, sign and gradient against the solids themselves, the surface being within a tenth of a voxel of them.
  Map map(testing::SceneInfo());
  const Eigen::Vector3d center(0.13, -0.21, 0.07);
  const auto ball = testing::Ball(center, 0.6);
  testing::ObserveBand(testing::AddThing(map), ball, testing::CubeAt(center, 0.8));
  const DistanceQuery query = QueryOf(map);
  for (const Eigen::Vector3d& p : testing::RandomPoints(800, 2, 5)) {
    const SurfaceDistance answer = query.At(p);
    ASSERT_NE(answer.submap, nullptr);
    const double truth = ball(p);
    EXPECT_NEAR(answer.distance_m, truth, 0.1 * kSceneVoxel_m) << "outside, in the band and deep inside";
    if (std::abs(truth) < 0.5 * kSceneVoxel_m || (p - center).norm() < 0.1) continue;
    EXPECT_GT(answer.gradient.dot((p - center).normalized()), std::cos(10 * M_PI / 180)) << truth;
  }
}

TEST(DistanceQuery, FindsASurfaceThatIsMillimetresAwayHoweverLargeTilesAre) {
  // A tilted plane in voxels of 0.2 m: where a tile is 6.4 m wide, coordinates are rounded by what counts near it.
  constexpr double kVoxel_m = 0.2;
  MapInfo info = testing::SceneInfo();
  info.config.voxel_size_m = kVoxel_m;
  info.config.truncation_m = 2 * kVoxel_m;
  Map map(info);
  Submap& submap = map.Create(
      {.panoptic = Panoptic::kStuff, .class_id = ClassId(1), .voxel_size_m = kVoxel_m, .truncation_m = 2 * kVoxel_m});
  const Eigen::Vector3d normal = Eigen::Vector3d(0.21, -0.13, 0.97).normalized();
  constexpr int kHalf_vox = 32;
  for (int y = -kHalf_vox; y < kHalf_vox; ++y) {
    for (int x = -kHalf_vox; x < kHalf_vox; ++x) {
      const int middle = static_cast<int>(std::floor(-(normal.x() * x + normal.y() * y) / normal.z()));
      for (int z = middle - 2; z <= middle + 2; ++z) {
        TsdfBlock& block = submap.MutableTsdf(BlockOf({x, y, z}));
        const auto i = static_cast<std::size_t>(LinearIndex({x, y, z}));
        block.distance_m[i] = static_cast<float>(normal.dot(VoxelCentre({x, y, z}, kVoxel_m)));
        block.weight[i] = 1;
      }
    }
  }
  submap.UpdateBoundingSphere();
  const DistanceQuery query = QueryOf(map);
  constexpr double kAside_m = 0.02;
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Eigen::Vector3d> points = testing::RandomPoints(20000, 1, 7);
  for (Eigen::Vector3d& p : points) p = 4 * (p.x() * u + p.y() * v) + kAside_m * p.z() * normal;
  std::vector<SurfaceDistance> batch(points.size());
  query.At(points, batch);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth_m = normal.dot(points[i]);
    for (const SurfaceDistance& answer : {query.At(points[i]), batch[i]}) {
      ASSERT_NE(answer.submap, nullptr) << points[i].transpose();
      ASSERT_NEAR(std::abs(answer.distance_m), std::abs(truth_m), 1e-4 * kVoxel_m);
      if (std::abs(truth_m) > 5e-4 * kVoxel_m) {
        ASSERT_EQ(answer.distance_m < 0, truth_m < 0) << truth_m;
      }
    }
  }
}

TEST(DistanceQuery, TellsTheSideAlsoAtSharpEdgesAndCorners) {
  // Nearest to most points around a slim pyramid is an edge or a corner.
  Map map(testing::SceneInfo());
  const auto pyramid = [](const Eigen::Vector3d& p) {
    const double slant = (std::max(std::abs(p.x()), std::abs(p.y())) * 3 + p.z() - 0.7) / std::sqrt(10);
    return std::max(slant, -p.z() - 0.2);
  };
  testing::ObserveBand(testing::AddThing(map), pyramid, testing::CubeAt({0, 0, 0.2}, 0.9));
  const DistanceQuery query = QueryOf(map);
  int num_inside = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(4000, 1.0, 5)) {
    if (std::abs(pyramid(p)) < kSceneVoxel_m) continue;
    num_inside += pyramid(p) < 0;
    EXPECT_EQ(query.At(p).distance_m < 0, pyramid(p) < 0) << p.transpose();
  }
  EXPECT_GT(num_inside, 10);
}

TEST(DistanceQuery, IsNegativeDeepBehindOnlyWhereNothingWasSeenInFront) {
  // A ball inside a ball: behind the outer surface, and near the inner one, which is seen from between.
  Map map(testing::SceneInfo());
  const auto wall = [](const Eigen::Vector3d& p) { return p.x(); };  // faces +x
  testing::ObserveBand(testing::AddThing(map), wall, testing::CubeAt({0, 0, 0}, 0.5));
  const Eigen::Vector3d behind(-0.3, 0.02, 0.03);
  EXPECT_NEAR(QueryOf(map).At(behind).distance_m, -0.3, 1e-3);
  EXPECT_EQ(QueryOf(map).At(behind).status, DistanceStatus::kUnknown);
  // Somebody else's surface faces the place, and it was observed before it.
  const auto other = [](const Eigen::Vector3d& p) { return p.x() + 0.44; };
  testing::ObserveBand(testing::AddThing(map), other, testing::CubeAt({-0.44, 0, 0}, 0.16));
  const SurfaceDistance between = QueryOf(map).At({-0.2, 0.02, 0.03});
  EXPECT_NEAR(between.distance_m, -0.2, 1e-3) << "nobody has seen this";
  const SurfaceDistance before_other = QueryOf(map).At({-0.305, 0.02, 0.03});
  EXPECT_NEAR(before_other.distance_m, 0.135, 1e-3) << "before the other wall";
}

TEST(DistanceQuery, TellsSeenFromUnseen) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.5), testing::CubeAt({0, 0, 0}, 0.7));
  EXPECT_EQ(QueryOf(map).At({0.55, 0, 0}).status, DistanceStatus::kOk);
  EXPECT_EQ(QueryOf(map).At({1.0, 0, 0}).status, DistanceStatus::kUnknown);
  EXPECT_EQ(QueryOf(map, {.unknown_is_free = true}).At({1.0, 0, 0}).status, DistanceStatus::kOk);
  EXPECT_EQ(QueryOf(map).At({9.0, 0, 0}).status, DistanceStatus::kClamped);
}

TEST(DistanceQuery, WhatWasLookedThroughIsKnownAndNotBehind) {
  Map map(testing::SceneInfo());
  const auto wall = [](const Eigen::Vector3d& p) { return p.x() - 0.6; };  // faces +x
  testing::ObserveBand(testing::AddThing(map), wall, testing::CubeAt({0.6, 0, 0}, 0.5));
  const Eigen::Vector3d p(0.1, 0.02, 0.03);
  EXPECT_EQ(QueryOf(map).At(p).status, DistanceStatus::kUnknown);
  EXPECT_NEAR(QueryOf(map).At(p).distance_m, -0.5, 1e-3);
  FreeBlocks seen;
  seen.full = 1u << CellOf({0, 0, 0});  // voxels up to 0.4 m
  map.mutable_free_space().Add(TileOf({0, 0, 0}), seen, 1);
  EXPECT_EQ(QueryOf(map).At(p).status, DistanceStatus::kOk);
  EXPECT_NEAR(QueryOf(map).At(p).distance_m, 0.5, 1e-3);
  EXPECT_LT(QueryOf(map).At({0.5, 0.02, 0.03}).distance_m, 0) << "in the band behind the surface";
}

TEST(DistanceQuery, LeavesOutWhatIsExcluded) {
  Map map = testing::FurnishedRoom();
  DistanceOptions options;
  options.scope.excluded_submaps = {SubmapId(4), SubmapId(1)};
  ExpectEqualsBruteForce(map, options, 50, 1.9);
  options.scope = {.excluded_classes = {ClassId(1), ClassId(3)}};
  ExpectEqualsBruteForce(map, options, 50, 1.9);
}

TEST(DistanceQuery, LeavesOutWhatIsAbsentUnlessAskedFor) {
  Map map = testing::FurnishedRoom();
  map.FindMutable(SubmapId(1))->mutable_info().presence = Presence::kAbsent;
  map.FindMutable(SubmapId(3))->mutable_info().presence = Presence::kAbsent;
  const auto state = map.Publish(0);
  SurfaceCache cache(std::size_t{1} << 30);
  const DistanceQuery present(cache.Of(state), {}), whole(cache.Of(state, /*with_absent=*/true), {});
  const AllTriangles all(*state),
      some(*state, [](const SubmapInfo&info) { return info.presence == Presence::kPresent; });
  int num_absent = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(80, 1.4, 27)) {
    const SurfaceDistance of_present = present.At(p), of_whole = whole.At(p);
    EXPECT_NEAR(std::abs(of_present.distance_m), some.Nearest(p).distance_m, 0.001 * kSceneVoxel_m);
    EXPECT_NEAR(std::abs(of_whole.distance_m), all.Nearest(p).distance_m, 0.001 * kSceneVoxel_m);
    EXPECT_EQ(of_present.submap->presence, Presence::kPresent);
    num_absent += of_whole.submap->presence == Presence::kAbsent;
  }
  EXPECT_GT(num_absent, 5);
  // Each of the two goes on from state to state by itself, and where nothing is absent they are one.
  EXPECT_EQ(cache.Of(state), cache.Of(state, false));
  map.FindMutable(SubmapId(1))->mutable_info().presence = Presence::kPresent;
  const auto next = map.Publish(1);
  EXPECT_EQ(cache.Of(next, true)->index().entries().size(), cache.Of(next)->index().entries().size() + 1);
  map.FindMutable(SubmapId(3))->mutable_info().presence = Presence::kPresent;
  const auto last = map.Publish(2);
  EXPECT_EQ(cache.Of(last, true).get(), cache.Of(last).get());
}

TEST(DistanceQuery, KeepsTheUnknownSubmapAsAnObstacleUnderFiltersOfClasses) {
  Map map = testing::FurnishedRoom();
  DistanceOptions options;
  options.scope.classes = {ClassId(2)};
  const DistanceQuery query = QueryOf(map, options);
  EXPECT_EQ(query.At({0.9, -0.9, -0.5}).submap->id, kUnknownSubmap);
  EXPECT_EQ(query.At({-0.7, -0.6, 0.3}).submap->id, SubmapId(2));
  ExpectEqualsBruteForce(map, options, 50, 1.9);
  options.scope.excluded_submaps = {kUnknownSubmap};
  EXPECT_EQ(QueryOf(map, options).At({0.9, -0.9, -0.5}).submap->id, SubmapId(2)) << "by its id it can be left out";
}

TEST(DistanceQuery, MovingAnObjectGivesTheAnswersOfAMapBuiltSo) {
  // The same voxels, once moved by a pose and once written where they are.
  Map moved(testing::SceneInfo()), built(testing::SceneInfo());
  const Eigen::Vector3d shift(8 * kSceneVoxel_m, -16 * kSceneVoxel_m, 3 * kSceneVoxel_m), center(0.2, 0.1, 0.4);
  testing::ObserveBand(testing::AddThing(moved), testing::Ball(center, 0.3), testing::CubeAt(center, 0.5));
  (void)moved.Publish(0);
  moved.FindMutable(SubmapId(1))->mutable_info().T_map_submap.translation() = shift;
  testing::ObserveBand(testing::AddThing(built), testing::Ball(center + shift, 0.3),
                       testing::CubeAt(center + shift, 0.5));
  const DistanceQuery a = QueryOf(moved), b = QueryOf(built);
  for (const Eigen::Vector3d& p : testing::RandomPoints(300, 1.5, 8)) {
    const SurfaceDistance of_moved = a.At(p), of_built = b.At(p);
    EXPECT_EQ(of_moved.status, of_built.status);
    EXPECT_NEAR(of_moved.distance_m, of_built.distance_m, 0.001 * kSceneVoxel_m);
  }
}

TEST(DistanceQuery, NeighboursThatShareASurfaceLeaveNoGap) {
  // A ball whose voxels belong to eight submaps in a chequered pattern of patches.
  Map map(testing::SceneInfo());
  const auto ball = testing::Ball({0, 0, 0}, 0.6);
  const auto patch = [](const Eigen::Vector3d& p) {
    return (p.x() > 0.02 ? 1 : 0) + (p.y() > -0.03 ? 2 : 0) + (p.z() > 0.1 ? 4 : 0);
  };
  for (int k = 0; k < 8; ++k) {
    testing::ObserveBand(testing::AddThing(map), ball, testing::CubeAt({0, 0, 0}, 0.8),
                         [&](const Eigen::Vector3d& p) { return patch(p) == k; });
  }
  const DistanceQuery query = QueryOf(map);
  for (const Eigen::Vector3d& p : testing::RandomPoints(1000, 1, 12)) {
    EXPECT_NEAR(query.At(p).distance_m, ball(p), 0.2 * kSceneVoxel_m) << p.transpose();
  }
}

TEST(DistanceQuery, PaddingIsTakenOffBySubmapClassOrDefault) {
  Map map = testing::FurnishedRoom();
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap.translate(Eigen::Vector3d(0.1, 0.2, 0));
  SurfacePadding padding{.default_m = 0.04};
  padding.classes = {{ClassId(1), 0.1}, {ClassId(3), 0.3}};
  padding.submaps = {{SubmapId(3), 0.25}};  // of class 1
  DistanceOptions options;
  options.scope.padding = padding;
  const DistanceQuery query = QueryOf(map, options);
  std::vector<std::pair<double, AllTriangles>> parts;
  for (const auto& submap : map.published()->submaps()) {
    parts.emplace_back(padding.Of(submap->info()),
                       AllTriangles(*map.published(), [&](const SubmapInfo& info) { return info.id == submap->id(); }));
  }
  EXPECT_EQ(parts[0].first, 0.04) << "unknown objects have no class";
  EXPECT_EQ(parts[1].first, 0.1);
  EXPECT_EQ(parts[3].first, 0.25);
  const auto points = testing::RandomPoints(60, 1.7, 23);
  std::vector<SurfaceDistance> batch(points.size());
  query.At(points, batch);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double reach_m = 9, padding_m = 0;
    SubmapId id;
    for (const auto& [pad_m, triangles] : parts) {
      const BruteNearest nearest = triangles.Nearest(points[i]);
      if (nearest.distance_m - pad_m < reach_m) {
        reach_m = nearest.distance_m - pad_m, padding_m = pad_m, id = nearest.submap;
      }
    }
    for (const SurfaceDistance& answer : {query.At(points[i]), batch[i]}) {
      EXPECT_EQ(answer.submap->id, id);
      EXPECT_NEAR(std::abs(answer.distance_m + padding_m) - padding_m, reach_m, 0.001 * kSceneVoxel_m);
      EXPECT_NEAR((points[i] - answer.nearest_m).norm(), reach_m + padding_m, 0.001 * kSceneVoxel_m);
    }
  }
}

TEST(DistanceQuery, PaddingReachesFromBeyondTheLimit) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.5), testing::CubeAt({0, 0, 0}, 0.7));
  DistanceOptions options{.max_distance_m = 0.3};
  options.scope.padding.default_m = 0.25;
  EXPECT_NEAR(QueryOf(map, options).At({1.0, 0, 0}).distance_m, 0.25, 0.1 * kSceneVoxel_m);
  EXPECT_EQ(QueryOf(map, options).At({1.1, 0, 0}).status, DistanceStatus::kClamped);
  EXPECT_EQ(QueryOf(map, options).At({1.1, 0, 0}).distance_m, 0.3);
  EXPECT_NEAR(QueryOf(map, options).At({0.6, 0, 0}).distance_m, -0.15, 0.1 * kSceneVoxel_m);
  EXPECT_GT(QueryOf(map, options).At({0.6, 0, 0}).gradient.x(), 0.99) << "within the padding it is the way out";
}

TEST(DistanceQuery, WhatIsAttachedIsNotThere) {
  Map map = testing::FurnishedRoom();
  DistanceOptions attached, excluded;
  attached.scope.attached = {SubmapId(1)};
  excluded.scope.excluded_submaps = {SubmapId(1)};
  const DistanceQuery a = QueryOf(map, attached), b = QueryOf(map, excluded);
  for (const Eigen::Vector3d& p : testing::RandomPoints(100, 1.5, 4)) {
    EXPECT_EQ(std::abs(a.At(p).distance_m), std::abs(b.At(p).distance_m));
    EXPECT_NE(a.At(p).submap->id, SubmapId(1));
  }
}

TEST(DistanceQuery, WhereAttachedThingsWereIsSeenAndFree) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.5), testing::CubeAt({0, 0, 0}, 0.7));
  testing::ObserveBand(testing::AddThing(map), testing::Ball({1.5, 0, 0}, 0.5), testing::CubeAt({1.5, 0, 0}, 0.7));
  DistanceOptions options;
  options.scope.attached = {SubmapId(1)};
  const DistanceQuery query = QueryOf(map, options);
  EXPECT_EQ(query.At({0, 0, 0}).status, DistanceStatus::kOk) << "inside";
  EXPECT_NEAR(query.At({0, 0, 0}).distance_m, 1, 0.1 * kSceneVoxel_m);
  EXPECT_EQ(query.At({0.45, 0, 0}).status, DistanceStatus::kOk) << "in its band";
  EXPECT_EQ(query.At({0, 0.9, 0}).status, DistanceStatus::kUnknown) << "beside it";
}

TEST(DistanceQuery, FreeSpaceThatIsTooOldIsUnknown) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0.2, 0.2, 3}, 0.5), testing::CubeAt({0.2, 0.2, 3}, 0.7));
  FreeBlocks seen;
  seen.full = ~std::uint64_t{0};
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  map.mutable_free_space().Add({0, 0, 0}, seen, 100 * kSecond_ns);
  map.mutable_free_space().Add({0, 0, 1}, seen, 160 * kSecond_ns);
  const Eigen::Vector3d old(0.2, 0.2, 1.0), late(0.2, 0.2, 1.8);
  const auto status = [&](const Eigen::Vector3d& p, std::optional<double> max_age_s) {
    DistanceOptions options;
    options.scope.max_free_age_s = max_age_s;
    return QueryOf(map, options).At(p).status;
  };
  EXPECT_EQ(status(old, std::nullopt), DistanceStatus::kOk);
  EXPECT_EQ(status(old, 61), DistanceStatus::kOk);
  EXPECT_EQ(status(old, 59), DistanceStatus::kUnknown);
  EXPECT_EQ(status(late, 59), DistanceStatus::kOk);
  EXPECT_EQ(status(late, 0), DistanceStatus::kOk);
  EXPECT_EQ(status(old, 1e300), DistanceStatus::kOk);
}

TEST(DistanceQuery, WhatAnObjectHasLeftIsFreeIfAskedForUntilSomethingIsSeenThere) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0.2, 0.2, 2}, 0.5), testing::CubeAt({0.2, 0.2, 2}, 0.7));
  FreeBlocks left;
  left.full = ~std::uint64_t{0};
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  map.mutable_vacated().Add({0, 0, 0}, left, 50 * kSecond_ns);
  FreeBlocks seen;
  seen.full = 1;
  map.mutable_free_space().Add({0, 0, 0}, seen, 100 * kSecond_ns);
  const auto ask = [&](const Eigen::Vector3d& p, bool vacated_is_free, std::optional<double> max_age_s = {}) {
    DistanceOptions options;
    options.scope.vacated_is_free = vacated_is_free;
    options.scope.max_free_age_s = max_age_s;
    return QueryOf(map, options).At(p);
  };
  const Eigen::Vector3d vacated(0.9, 0.9, 0.9), looked_through(0.1, 0.1, 0.1), never(0.2, 0.2, 1.9),
      band(0.2, 0.2, 1.6);
  EXPECT_EQ(ask(vacated, false).status, DistanceStatus::kUnknown);
  EXPECT_EQ(ask(vacated, true).status, DistanceStatus::kOk);
  EXPECT_GT(ask(vacated, true).distance_m, 0.5);
  EXPECT_EQ(ask(vacated, true, 49).status, DistanceStatus::kUnknown) << "too old";
  EXPECT_EQ(ask(vacated, true, 51).status, DistanceStatus::kOk);
  EXPECT_EQ(ask(looked_through, true, 49).status, DistanceStatus::kOk) << "in the same tile, but seen since";
  EXPECT_EQ(ask(never, true).status, DistanceStatus::kUnknown);
  // Where a surface has been seen since, that counts.
  map.mutable_vacated().Add({0, 0, 1}, left, 50 * kSecond_ns);
  EXPECT_LT(ask(band, true).distance_m, 0);
  EXPECT_NEAR(ask(band, true).distance_m, ask(band, false).distance_m, 1e-6);
}

TEST(DistanceQuery, OfAnEmptyMapIsClamped) {
  Map map(testing::SceneInfo());
  EXPECT_EQ(QueryOf(map).At({0, 0, 0}).status, DistanceStatus::kClamped);
  QueryOf(map).At({}, {});
}

TEST(DistanceQuery, PointsBeyondAllNumbersAreClamped) {
  Map map = testing::FurnishedRoom();
  const DistanceQuery query = QueryOf(map);
  for (const double far : {1e12, 1e30, 1e300}) {
    EXPECT_EQ(query.At({far, -far, 0.5}).status, DistanceStatus::kClamped);
  }
}

}  // namespace
}  // namespace dhpmap
