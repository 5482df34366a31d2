// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "mapping/geometry/surface_rim.h"
#include "mapping/query/distance_query.h"
#include "tests/unit/mapping/query/surface_scene.h"

// On which side of a surface that is seen in part only a place is.

namespace dhpmap {
namespace {

using testing::kSceneTruncation_m;
using testing::kSceneVoxel_m;

constexpr double kFaceHalf_m = 0.375;  ///< to the centre of the last voxel that was seen

/// A box of which nobody has seen more than the side that faces +x: |y|, |z| < 0.4.
Map BoxSeenFromOneSide(const Transform& T = Transform::Identity()) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(
      testing::AddThing(map, ClassId(1), T), [](const Eigen::Vector3d& p) { return p.x(); },
      testing::CubeAt({0, 0, 0}, 0.5),
      [](const Eigen::Vector3d& p) { return std::abs(p.y()) < 0.4 && std::abs(p.z()) < 0.4; });
  return map;
}

/// How far a point is off the face to the side.
double Aside_m(const Eigen::Vector3d& p) {
  return Eigen::Vector2d(std::max(std::abs(p.y()) - kFaceHalf_m, 0.0), std::max(std::abs(p.z()) - kFaceHalf_m, 0.0))
      .norm();
}

/// Whether the point's voxel is one of those seen.
bool IsInSeenVoxel(const Eigen::Vector3d& p) {
  const Eigen::Vector3d centre = VoxelCentre(VoxelAt(p, kSceneVoxel_m), kSceneVoxel_m);
  return std::abs(centre.x()) <= kSceneTruncation_m && std::abs(centre.y()) < 0.4 && std::abs(centre.z()) < 0.4;
}

/// Straight behind the face, or beside it where the voxel was seen to be.
bool IsBehind(const Eigen::Vector3d& p) { return p.x() < 0 && (Aside_m(p) == 0 || IsInSeenVoxel(p)); }

/// In the plane of the face, or straight behind its edge but for a degree or two.
bool IsTooCloseToTell(const Eigen::Vector3d& p) {
  const double aside_m = Aside_m(p), behind_m = std::abs(p.x());
  return behind_m < 1e-3 || (aside_m > 0 && aside_m < 1e-3 + std::tan(2 * M_PI / 180) * behind_m);
}

void ExpectSidesOfTheFace(const DistanceQuery& query, const Transform& T_map_box, unsigned seed) {
  const auto points = testing::RandomPoints(1500, 1.2, seed);
  std::vector<Eigen::Vector3d> points_map;
  for (const Eigen::Vector3d& p : points) points_map.push_back(T_map_box * p);
  std::vector<SurfaceDistance> batch(points.size());
  query.At(points_map, batch);
  int num_beside = 0, num_inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = points[i];
    if (IsTooCloseToTell(p)) continue;
    const double truth_m = std::hypot(p.x(), Aside_m(p));
    const bool is_inside = IsBehind(p);
    num_inside += is_inside;
    num_beside += p.x() < 0 && !is_inside;
    for (const SurfaceDistance& answer : {query.At(points_map[i]), batch[i]}) {
      ASSERT_NE(answer.submap, nullptr);
      EXPECT_NEAR(answer.distance_m, is_inside ? -truth_m : truth_m, 0.01 * kSceneVoxel_m) << p.transpose();
      EXPECT_EQ(answer.status, IsInSeenVoxel(p) ? DistanceStatus::kOk : DistanceStatus::kUnknown) << p.transpose();
      const double ahead_m = (points_map[i] - answer.distance_m * answer.gradient - answer.nearest_m).norm();
      EXPECT_NEAR(ahead_m, 0, 1e-3 * kSceneVoxel_m);
    }
  }
  EXPECT_GT(num_inside, 50);
  EXPECT_GT(num_beside, 300);
}

TEST(DistanceSides, BesideABoxSeenFromOneSideIsNotInsideIt) {
  Map map = BoxSeenFromOneSide();
  SurfaceCache cache(std::size_t{1} << 30);
  ExpectSidesOfTheFace(DistanceQuery(cache.Of(map.Publish(0)), {}), Transform::Identity(), 3);
}

TEST(DistanceSides, NorWhereTheBoxWasMovedAndTurned) {
  Transform T = Transform::Identity();
  T.translate(Eigen::Vector3d(0.31, -0.17, 0.43));
  Map map = BoxSeenFromOneSide(T);
  SurfaceCache cache(std::size_t{1} << 30);
  ExpectSidesOfTheFace(DistanceQuery(cache.Of(map.Publish(0)), {}), T, 4);
  T.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  map = BoxSeenFromOneSide(T);
  ExpectSidesOfTheFace(DistanceQuery(cache.Of(map.Publish(0)), {}), T, 5);
}

TEST(DistanceSides, NorByNearFields) {
  Map map = BoxSeenFromOneSide();
  SurfaceCache cache(std::size_t{1} << 30);
  const DistanceQuery quick(cache.Of(map.Publish(0)), {.tolerance_vox = 0.5});
  constexpr int kTimesAsked = 70;  // more often than a cell must be asked for to be made
  const auto points = testing::RandomPoints(200, 1.0, 6);
  std::vector<SurfaceDistance> answers(points.size());
  for (int n = 0; n < kTimesAsked; ++n) quick.At(points, answers);
  int num_beside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = points[i];
    if (IsTooCloseToTell(p)) continue;
    const bool is_inside = IsBehind(p);
    num_beside += p.x() < 0 && !is_inside;
    EXPECT_EQ(answers[i].distance_m < 0, is_inside) << p.transpose();
    EXPECT_EQ(quick.At(p).distance_m < 0, is_inside) << p.transpose();
    EXPECT_NEAR(std::abs(answers[i].distance_m), std::hypot(p.x(), Aside_m(p)), 0.41 * kSceneVoxel_m);
  }
  EXPECT_GT(num_beside, 30);
}

TEST(DistanceSides, AVoxelThatWasSeenBehindASurfaceTellsBesideAnother) {
  // A face that another submap goes on with, behind and aside: what is seen there is inside.
  Map map = BoxSeenFromOneSide();
  const Eigen::Vector3d p(-0.12, 0.47, 0.02);
  SurfaceCache cache(std::size_t{1} << 30);
  EXPECT_GT(DistanceQuery(cache.Of(map.Publish(0)), {}).At(p).distance_m, 0);
  Submap& other = testing::AddThing(map);
  TsdfBlock& block = other.MutableTsdf(BlockOf(VoxelAt(p, kSceneVoxel_m)));
  const auto i = static_cast<std::size_t>(LinearIndex(VoxelAt(p, kSceneVoxel_m)));
  block.distance_m[i] = -0.1f;
  block.weight[i] = 1;
  other.UpdateBoundingSphere();
  const SurfaceDistance inside = DistanceQuery(cache.Of(map.Publish(1)), {}).At(p);
  EXPECT_NEAR(inside.distance_m, -std::hypot(p.x(), Aside_m(p)), 0.01 * kSceneVoxel_m);
  EXPECT_EQ(inside.status, DistanceStatus::kOk);
}

TEST(DistanceSides, BehindTheEdgesOfAClosedSolidIsStillInside) {
  // A cross in section: from within, the nearest are its inner edges, on which surfaces go on.
  Map map(testing::SceneInfo());
  const auto cross = [](const Eigen::Vector3d& p) {
    const double across = std::min(std::max(std::abs(p.x()) - 0.9, std::abs(p.y()) - 0.45),
                                   std::max(std::abs(p.x()) - 0.45, std::abs(p.y()) - 0.9));
    return std::max(across, std::abs(p.z()) - 0.9);
  };
  testing::ObserveBand(testing::AddThing(map), cross, testing::CubeAt({0, 0, 0}, 1.1));
  SurfaceCache cache(std::size_t{1} << 30);
  const DistanceQuery query(cache.Of(map.Publish(0)), {});
  int num_by_edges = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(800, 0.4, 7)) {
    // Within the middle every way out is by one of the four inner edges, or by an end.
    const double edge_m = std::hypot(0.45 - std::abs(p.x()), 0.45 - std::abs(p.y()));
    const double end_m = 0.9 - std::abs(p.z());
    num_by_edges += edge_m < end_m - kSceneVoxel_m;
    EXPECT_NEAR(query.At(p).distance_m, -std::min(edge_m, end_m), kSceneVoxel_m) << p.transpose();
  }
  EXPECT_GT(num_by_edges, 300);
}

TEST(SurfaceRim, IsAnEdgeOfOneTriangleOrACornerWithOne) {
  using Corner = Eigen::Vector3f;
  const Corner o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), minus_x(-1, 0, 0), minus_y(0, -1, 0);
  constexpr float kSame_m = 1e-5f;
  // A closed fan of four around a corner, seen from each of them; and with one left out.
  const std::array<TriangleCorners, 4> fan = {
      TriangleCorners{o, x, y}, {o, y, minus_x}, {o, minus_x, minus_y}, {minus_y, x, o}};
  EXPECT_FALSE(EndsAtOrigin(fan, kSame_m));
  EXPECT_TRUE(EndsAtOrigin(std::span(fan).first(3), kSame_m));
  EXPECT_TRUE(EndsAtOrigin(std::span(fan).last(1), kSame_m));
  // In the middle of an edge: alone, shared, and beside another that only touches its end.
  const auto moved = [](TriangleCorners triangle, const Corner& by) {
    for (Corner& corner : triangle) corner += by;
    return triangle;
  };
  const Corner half(-0.5f, 0, 0);
  const std::array<TriangleCorners, 2> shared = {moved({o, x, y}, half), moved({x, o, minus_y}, half)};
  EXPECT_FALSE(EndsAtOrigin(shared, kSame_m));
  EXPECT_TRUE(EndsAtOrigin(std::span(shared).first(1), kSame_m));
  const std::array<TriangleCorners, 2> touching = {moved({o, x, y}, half), moved({o, minus_x, minus_y}, half)};
  EXPECT_TRUE(EndsAtOrigin(touching, kSame_m));
  // Within a triangle, though it be alone.
  const std::array<TriangleCorners, 1> within = {moved({o, x, y}, Corner(-0.3f, -0.3f, 0))};
  EXPECT_FALSE(EndsAtOrigin(within, kSame_m));
}

TEST(SurfaceRim, TakesCornersThatRoundingHasPartedForOne) {
  using Corner = Eigen::Vector3f;
  const std::array<TriangleCorners, 2> shared = {
      TriangleCorners{Corner(-0.5f, 0, 0), Corner(0.5f, 0, 0), Corner(0, 1, 0)},
      {Corner(0.5f, 4e-6f, 0), Corner(-0.5f, 0, -4e-6f), Corner(0, -1, 0)}};
  EXPECT_FALSE(EndsAtOrigin(shared, 1e-5f));
  EXPECT_TRUE(EndsAtOrigin(shared, 1e-6f));
}

}  // namespace
}  // namespace dhpmap
