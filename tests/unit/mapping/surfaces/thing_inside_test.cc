// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/thing_inside.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mapping/query/body_query.h"
#include "mapping/query/occupancy_slice.h"
#include "mapping/query/point_lookup.h"
#include "mapping/query/trajectory_query.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

// Of things that are seen in part, what nobody has seen is solid all the same.

namespace dhpmap {
namespace {

using testing::kSceneVoxel_m;

const Eigen::Vector3d kCupboardHalf_m(0.4, 0.3, 0.6);

double OffTheCupboard(const Eigen::Vector3d& p) {
  return testing::Block(Eigen::Vector3d(0, 0, kCupboardHalf_m.z()), kCupboardHalf_m)(p);
}

/// A cupboard on a floor at z = 0 and against a wall at y = 0.3, of which the upper part of its front and of its left
/// side were seen, and of floor and wall what it does not hide.
Map CupboardAtAWall() {
  Map map(testing::SceneInfo());
  const Eigen::AlignedBox3d around(Eigen::Vector3d(-1.5, -1.2, -0.3), Eigen::Vector3d(1.5, 0.6, 1.8));
  testing::ObserveBand(testing::AddThing(map), OffTheCupboard, around, [](const Eigen::Vector3d& p) {
    return p.z() > 0.4 && p.z() < 1.2 && (p.y() < -0.15 || (p.x() < -0.25 && p.y() < 0.1));
  });
  const auto is_hidden = [](const Eigen::Vector3d& p) { return std::abs(p.x()) < 0.45 && p.y() > -0.35; };
  Submap& background = testing::AddThing(map, ClassId(3));
  background.mutable_info().panoptic = Panoptic::kStuff;
  testing::ObserveBand(
      background, [](const Eigen::Vector3d& p) { return std::min(p.z(), 0.3 - p.y()); }, around,
      [&](const Eigen::Vector3d& p) { return !is_hidden(p); });
  testing::LookThrough(map, around, [&](const Eigen::Vector3d& p) {
    return !is_hidden(p) && OffTheCupboard(p) > 0.15 && p.z() > 0.15 && p.y() < 0.15;
  });
  return map;
}

std::vector<Eigen::Vector3d> PointsWhere(const std::function<bool(const Eigen::Vector3d&)>& is_wanted) {
  std::vector<Eigen::Vector3d> points = testing::RandomPoints(12000, 1.5, 17);
  std::erase_if(points, [&](const Eigen::Vector3d& p) { return !is_wanted(p); });
  return points;
}

std::int8_t CellAround(const std::shared_ptr<const MapSurfaces>& surfaces, const Eigen::Vector3d& p) {
  OccupancySlice slice(surfaces, {.min_z_m = p.z() - 0.02,
                                  .max_z_m = p.z() + 0.02,
                                  .resolution_m = 0.04,
                                  .min_m = p.head<2>().array() - 0.02,
                                  .width = 1,
                                  .height = 1,
                                  .unknown = kFreeCell,
                                  .scope = {}});
  std::int8_t cell = kUnknownCell;
  slice.Row(0, {&cell, 1}, {});
  return cell;
}

TEST(ThingInside, OfACupboardAtAWallIsSolidToEverybody) {
  Map map = CupboardAtAWall();
  const auto surfaces = testing::SurfacesOf(map);
  const DistanceQuery distances(surfaces, {.unknown_is_free = true}), reported(surfaces, {});
  const BodyQuery bodies(surfaces, testing::kIgnoringUnknown);
  const auto motions = TrajectoryQuery::Make(surfaces, {.bodies = testing::kIgnoringUnknown, .attached = {}});
  const PointLookup lookup(map.published());
  // Of the box that its surface spans: nobody has seen more of it.
  const auto points = PointsWhere([](const Eigen::Vector3d& p) {
    return OffTheCupboard(p) < -0.01 && p.z() > 0.5 && p.z() < 1.1 && p.x() < 0.35 && p.y() < 0.05;
  });
  ASSERT_GT(points.size(), 40u);
  for (const Eigen::Vector3d& p : points) {
    EXPECT_LT(distances.At(p).distance_m, 0) << p.transpose();
    EXPECT_LT(reported.At(p).distance_m, 0) << p.transpose();
    EXPECT_TRUE(bodies.Test(Capsule{p, p, 0.001}).is_colliding) << p.transpose();
    EXPECT_TRUE(bodies.Check(Capsule{p, p, 0.001}).is_colliding) << p.transpose();
    RobotMotion motion;
    motion.spheres = {{{0, p, 0.001}, {1, p, 0.001}}};
    EXPECT_FALSE(motions->Check(motion)->is_valid) << p.transpose();
    EXPECT_EQ(CellAround(surfaces, p), kOccupiedCell) << p.transpose();
    EXPECT_FALSE(lookup.At(p).is_free) << p.transpose();
  }
}

TEST(ThingInside, EndsWhereTheThingDoes) {
  Map map = CupboardAtAWall();
  const DistanceQuery distances(testing::SurfacesOf(map), {.unknown_is_free = true});
  const auto above = PointsWhere(
      [](const Eigen::Vector3d& p) { return std::abs(p.x()) < 0.3 && p.y() > -0.2 && p.y() < 0.25 && p.z() > 1.25; });
  ASSERT_GT(above.size(), 5u);
  for (const Eigen::Vector3d& p : above) EXPECT_GT(distances.At(p).distance_m, 0) << p.transpose();
}

/// A face of 0.75 x 0.75 m at x = 0 that looks to +x; no sensor has seen its other sides. 0.9 m behind it is the face
/// of another object, which sensors saw only where the first does not hide it. Some places between them are nearer to
/// it.
Map FaceBeforeAnother(Panoptic panoptic) {
  Map map(testing::SceneInfo());
  Submap& thing = testing::AddThing(map);
  thing.mutable_info().panoptic = panoptic;
  testing::ObserveBand(
      thing, [](const Eigen::Vector3d& p) { return p.x(); }, testing::CubeAt({0, 0, 0}, 0.5),
      [](const Eigen::Vector3d& p) { return std::abs(p.y()) < 0.4 && std::abs(p.z()) < 0.4; });
  Submap& wall = testing::AddThing(map, ClassId(3));
  wall.mutable_info().panoptic = Panoptic::kStuff;
  testing::ObserveBand(
      wall, [](const Eigen::Vector3d& p) { return p.x() + 0.9; }, testing::CubeAt({-0.9, 0, 0}, 1),
      [](const Eigen::Vector3d& p) { return std::abs(p.y()) > 0.45; });
  return map;
}

const Eigen::Vector3d kWithin(-0.68, 0.3, 0), kBeyond(-0.8, 0.3, 0);

TEST(ThingInside, OfAThingSeenFromOneSideIsAsDeepAsItIsWide) {
  Map map = FaceBeforeAnother(Panoptic::kThing);
  const auto surfaces = testing::SurfacesOf(map);
  const DistanceQuery distances(surfaces, {.unknown_is_free = true});
  EXPECT_LT(distances.At(kWithin).distance_m, 0);
  EXPECT_EQ(distances.At(kWithin).submap->id, SubmapId(2)) << "which is nearest all the same";
  EXPECT_GT(distances.At(kBeyond).distance_m, 0);
  const Eigen::Vector3d in_front(-0.68, 0.47, 0);  // of what was seen of the other
  EXPECT_GT(distances.At(in_front).distance_m, 0);
  EXPECT_GT(DistanceQuery(surfaces, {.scope = {.excluded_submaps = {SubmapId(1)}}}).At(kWithin).distance_m, 0);
}

TEST(ThingInside, OfBackgroundThereIsNone) {
  Map map = FaceBeforeAnother(Panoptic::kStuff);
  EXPECT_GT(DistanceQuery(testing::SurfacesOf(map), {.unknown_is_free = true}).At(kWithin).distance_m, 0);
}

TEST(ThingInside, GoesWithTheThing) {
  Map map = FaceBeforeAnother(Panoptic::kThing);
  Transform T = Transform::Identity();
  T.translate(Eigen::Vector3d(0.1, 5, 0.2));
  T.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  for (const SubmapId id : {SubmapId(1), SubmapId(2)}) map.FindMutable(id)->mutable_info().T_map_submap = T;
  const DistanceQuery distances(testing::SurfacesOf(map), {.unknown_is_free = true});
  EXPECT_LT(distances.At(T * kWithin).distance_m, 0);
  EXPECT_GT(distances.At(T * kBeyond).distance_m, 0);
  EXPECT_GT(distances.At(kWithin).distance_m, 0) << "it has left";
}

TEST(ThingInside, WhatWasLookedThroughIsNot) {
  Map map = FaceBeforeAnother(Panoptic::kThing);
  testing::LookThrough(map, testing::CubeAt(kWithin, 0.1), [](const Eigen::Vector3d&) { return true; });
  EXPECT_GT(DistanceQuery(testing::SurfacesOf(map), {.unknown_is_free = true}).At(kWithin).distance_m, 0);
}

}  // namespace
}  // namespace dhpmap
