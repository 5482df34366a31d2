// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/ray_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kSceneVoxel_m;

RayQuery RayQueryOf(Map& map, RayOptions options = {}) {
  SurfaceCache cache(std::size_t{1} << 30);
  return {cache.Of(map.Publish(0)), std::move(options)};
}

std::vector<Ray> RandomRays(int count, double half_m, unsigned seed) {
  const auto origins = testing::RandomPoints(count, half_m, seed),
             directions = testing::RandomPoints(count, 1, seed + 1);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < origins.size(); ++i) rays.push_back({origins[i], directions[i].normalized()});
  for (int axis = 0; axis < 3; ++axis) rays.push_back({origins[0], Eigen::Vector3d::Unit(axis)});
  return rays;
}

/// Where a ray meets the triangle's plane, if that is on the triangle's side of each edge, by `over_m` or more.
std::optional<double> Meeting(const Ray& ray, const std::array<Eigen::Vector3d, 3>& t, double over_m) {
  const Eigen::Vector3d across = (t[1] - t[0]).cross(t[2] - t[0]);
  if (across.norm() < 1e-12) return std::nullopt;
  const Eigen::Vector3d normal = across.normalized();
  const double slope = normal.dot(ray.direction);
  if (std::abs(slope) < 1e-9) return std::nullopt;
  const double along = normal.dot(t[0] - ray.origin_m) / slope;
  const Eigen::Vector3d p = ray.origin_m + along * ray.direction;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d edge = (t[(i + 1) % 3] - t[i]).normalized();
    if (edge.cross(p - t[i]).dot(normal) < over_m) return std::nullopt;
  }
  return along >= 0 ? std::optional(along) : std::nullopt;
}

void ExpectRaysEqualBruteForce(Map& map, const RayOptions& options) {
  const RayQuery query = RayQueryOf(map, options);
  std::vector<std::array<Eigen::Vector3d, 3>> all;
  for (const auto& submap : map.published()->submaps()) {
    if (!options.scope.Holds(submap->info())) continue;
    const auto triangles = testing::TrianglesInMap(*submap);
    all.insert(all.end(), triangles.begin(), triangles.end());
  }
  int num_hits = 0, num_misses = 0;
  for (const Ray& ray : RandomRays(150, 2.2, 21)) {
    double surely_m = options.max_distance_m, perhaps_m = options.max_distance_m;
    for (const auto& t : all) {
      surely_m = std::min(surely_m, Meeting(ray, t, 1e-6).value_or(1e9));
      perhaps_m = std::min(perhaps_m, Meeting(ray, t, -1e-6).value_or(1e9));
    }
    const RayHit hit = query.Cast(ray);
    EXPECT_LE(hit.distance_m, surely_m + 1e-5);
    EXPECT_GE(hit.distance_m, perhaps_m - 1e-5);
    EXPECT_LE(hit.free_m, hit.distance_m);
    (hit.submap != nullptr ? num_hits : num_misses) += 1;
    if (hit.submap == nullptr) {
      EXPECT_EQ(hit.distance_m, options.max_distance_m);
      EXPECT_TRUE(hit.point_m.hasNaN() && hit.normal.hasNaN());
    } else {
      EXPECT_NEAR((ray.origin_m + hit.distance_m * ray.direction - hit.point_m).norm(), 0, 1e-9);
      EXPECT_NEAR(hit.normal.norm(), 1, 1e-5);
    }
  }
  EXPECT_GT(num_hits, 30);
  EXPECT_GT(num_misses, 5);
}

TEST(RayQuery, EqualsBruteForceOverAllTriangles) {
  Map map = testing::FurnishedRoom();
  ExpectRaysEqualBruteForce(map, {.max_distance_m = 1.5});
}

TEST(MeetsSubmap, SaysWhetherARayToThatSubmapAloneHitsIt) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(std::size_t{1} << 30);
  const auto surfaces = cache.Of(map.Publish(0));
  int num_met = 0;
  for (std::size_t number = 0; number < surfaces->index().entries().size(); ++number) {
    RayOptions options{.max_distance_m = 1.5};
    options.scope.submaps = std::vector{surfaces->index().entries()[number].submap().id()};
    const RayQuery alone(surfaces, options);
    for (const Ray& ray : RandomRays(150, 2.2, 22)) {
      const bool is_met = MeetsSubmap(*surfaces, number, ray, options.max_distance_m);
      EXPECT_EQ(is_met, alone.Cast(ray).submap != nullptr);
      num_met += is_met;
    }
  }
  EXPECT_GT(num_met, 30);
}

TEST(RayQuery, EqualsBruteForceWhereObjectsAreMovedClonedAndLeftOut) {
  Map map = testing::FurnishedRoom();
  std::mt19937 random(31);
  for (const std::uint32_t id : {1u, 2u, 0u}) {
    map.FindMutable(SubmapId(id))->mutable_info().T_map_submap = testing::RandomPose(random, 0.7);
    map.Clone(SubmapId(id))->mutable_info().T_map_submap = testing::RandomPose(random, 1.0);
  }
  RayOptions options{.max_distance_m = 1.5};
  options.scope.excluded_submaps = {SubmapId(3)};
  ExpectRaysEqualBruteForce(map, options);
}

TEST(RayQuery, MeetsTheSceneAndNamesTheObject) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.5), testing::CubeAt({0, 0, 0}, 0.7));
  const RayQuery query = RayQueryOf(map);
  for (const Eigen::Vector3d& p : testing::RandomPoints(200, 2, 41)) {
    if (p.norm() < 0.8) continue;
    const Ray ray{p, -p.normalized()};
    const RayHit hit = query.Cast(ray);
    ASSERT_NE(hit.submap, nullptr) << p.transpose();
    EXPECT_EQ(hit.submap->id, SubmapId(1));
    EXPECT_NEAR(hit.distance_m, p.norm() - 0.5, 0.1 * kSceneVoxel_m);
    EXPECT_GT(hit.normal.dot(p.normalized()), 0.97);
    EXPECT_EQ(query.Cast({p, p.normalized()}).submap, nullptr) << "away from it";
  }
  EXPECT_NEAR(query.Cast({{0, 0, 0}, {1, 0, 0}}).distance_m, 0.5, 0.1 * kSceneVoxel_m) << "from behind";
}

TEST(RayQuery, NoRaySlipsThroughAClosedSurface) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Room({0, 0, 0}, {0.52, 0.47, 0.55}),
                       testing::CubeAt({0, 0, 0}, 0.8));
  const RayQuery query = RayQueryOf(map, {.unknown_is_free = true});
  for (const Eigen::Vector3d& target : testing::RandomPoints(4000, 1, 43)) {
    EXPECT_NE(query.Cast({{0.01, 0.02, 0.03}, target.normalized()}).submap, nullptr);
  }
}

TEST(RayQuery, TellsWhereTheUnseenBegins) {
  Map map(testing::SceneInfo());
  const auto wall = [](const Eigen::Vector3d& p) { return 1.0 - p.x(); };  // faces -x
  testing::ObserveBand(testing::AddThing(map), wall, testing::CubeAt({1, 0, 0}, 0.4));
  const Ray ray{{0.02, 0.02, 0.02}, {1, 0, 0}};
  const RayHit from_unseen = RayQueryOf(map).Cast(ray);
  EXPECT_TRUE(from_unseen.is_unknown);
  EXPECT_EQ(from_unseen.free_m, 0);
  EXPECT_NEAR(from_unseen.distance_m, 0.98, 1e-3) << "the wall is met all the same";
  // Somebody looked through the block at the origin: its eight voxels of 0.05 m end at 0.4.
  FreeBlocks seen;
  seen.full = 1u << CellOf({0, 0, 0});
  map.mutable_free_space().Add(TileOf({0, 0, 0}), seen, 1);
  EXPECT_NEAR(RayQueryOf(map).Cast(ray).free_m, 0.4 - 0.02, 1e-9);
  const RayHit along_wall = RayQueryOf(map).Cast({{0.88, 0.02, 0.02}, {1, 0, 0}});
  EXPECT_FALSE(along_wall.is_unknown) << "the band before a surface is seen";
  EXPECT_EQ(along_wall.free_m, along_wall.distance_m);
  EXPECT_FALSE(RayQueryOf(map, {.unknown_is_free = true}).Cast(ray).is_unknown);
}

TEST(RayQuery, FromBeyondAllNumbersMeetsNothing) {
  Map map = testing::FurnishedRoom();
  for (const double far : {1e12, 1e300}) {
    const RayHit hit = RayQueryOf(map).Cast({{far, 0, 0}, {-1, 0, 0}});
    EXPECT_EQ(hit.submap, nullptr);
    EXPECT_EQ(hit.free_m, 0);
  }
}

}  // namespace
}  // namespace dhpmap
