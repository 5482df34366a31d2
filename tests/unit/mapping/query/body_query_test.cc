// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/body_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "mapping/query/unseen_voxels.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::AllTriangles;
using testing::kIgnoringUnknown;
using testing::kSceneVoxel_m;
using testing::SurfacesOf;

Body Sphere(const Eigen::Vector3d& center_m, double radius_m) { return Capsule{center_m, center_m, radius_m}; }

/// Things moved, turned and cloned in the furnished room.
Map MovedRoom() {
  Map map = testing::FurnishedRoom();
  std::mt19937 random(11);
  for (const std::uint32_t id : {1u, 2u}) {
    map.FindMutable(SubmapId(id))->mutable_info().T_map_submap = testing::RandomPose(random, 0.5);
  }
  map.Clone(SubmapId(2))->mutable_info().T_map_submap = testing::RandomPose(random, 0.8);
  return map;
}

TEST(BodyQuery, SpheresTouchWhatIsWithinTheirRadius) {
  Map map = MovedRoom();
  const auto surfaces = SurfacesOf(map);
  BodyOptions options = kIgnoringUnknown;
  options.scope.excluded_submaps = {SubmapId(3)};
  const AllTriangles all(*map.published(), [&](const SubmapInfo& info) { return options.scope.Holds(info); });
  const DistanceQuery distances(surfaces, {.scope = options.scope});
  const BodyQuery query(surfaces, options);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> radius(0, 0.25);
  int num_colliding = 0, num_inside = 0, num_clear = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(200, 1.4, 21)) {
    const double radius_m = radius(random);
    const testing::BruteNearest nearest = all.Nearest(p);
    const bool touches = nearest.distance_m <= radius_m;
    const double distance_m = distances.At(p).distance_m;
    const BodyAnswer tested = query.Test(Sphere(p, radius_m)), checked = query.Check(Sphere(p, radius_m));
    EXPECT_EQ(tested.is_colliding, touches || distance_m < 0) << p.transpose();
    EXPECT_EQ(checked.is_colliding, tested.is_colliding);
    EXPECT_TRUE(tested.contacts.empty());
    ASSERT_EQ(checked.contacts.size(), checked.is_colliding ? 1u : 0u);
    num_clear += !checked.is_colliding;
    if (!checked.is_colliding) continue;
    ++num_colliding;
    num_inside += !touches;
    const BodyContact& contact = checked.contacts[0];
    EXPECT_EQ(contact.submap->id, nearest.submap);
    EXPECT_NEAR((contact.point_m - p).norm(), nearest.distance_m, 1e-4);
    EXPECT_NEAR(contact.depth_m, (touches ? radius_m : 0) - distance_m, 1e-4);
    EXPECT_NEAR(contact.normal.norm(), 1, 1e-5);
  }
  EXPECT_GT(num_colliding, 10);
  EXPECT_GT(num_inside, 0);
  EXPECT_GT(num_clear, 20);
}

TEST(BodyQuery, CapsulesTouchWhatIsWithinTheirRadiusOfTheirAxis) {
  Map map = MovedRoom();
  const auto surfaces = SurfacesOf(map);
  const DistanceQuery distances(surfaces, {});
  const BodyQuery query(surfaces, kIgnoringUnknown);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  int num_touching = 0, num_clear = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(300, 1.4, 8)) {
    const Capsule capsule{p, p + 0.4 * Eigen::Vector3d{unit(random), unit(random), unit(random)},
                          0.1 + 0.1 * unit(random)};
    constexpr int kSteps = 100;
    double least_m = std::numeric_limits<double>::infinity(), signed_m = least_m;
    for (int i = 0; i <= kSteps; ++i) {
      const double d = distances.At(p + i * 1.0 / kSteps * (capsule.b_m - p)).distance_m;
      least_m = std::min(least_m, std::abs(d));
      signed_m = std::min(signed_m, d);
    }
    const double step_m = (capsule.b_m - p).norm() / kSteps;
    const bool is_colliding = query.Test(capsule).is_colliding;
    const BodyAnswer checked = query.Check(capsule);
    EXPECT_EQ(checked.is_colliding, is_colliding);
    if (least_m <= capsule.radius_m || signed_m < -step_m) {
      EXPECT_TRUE(is_colliding) << least_m;
    }
    if (signed_m > capsule.radius_m + step_m) {
      EXPECT_FALSE(is_colliding) << signed_m;
    }
    ++(is_colliding ? num_touching : num_clear);
    if (!is_colliding || least_m > capsule.radius_m || least_m < 2 * step_m || signed_m < 0) continue;
    EXPECT_NEAR(checked.contacts[0].depth_m, capsule.radius_m - least_m, step_m);
  }
  EXPECT_GT(num_touching, 50);
  EXPECT_GT(num_clear, 50);
}

TEST(BodyQuery, BoxesTouchTrianglesThatHaveAPointInThem) {
  Map map = MovedRoom();
  const auto surfaces = SurfacesOf(map);
  std::vector<std::pair<SubmapId, Eigen::Vector3d>> samples;  // of triangles at most a voxel wide
  for (const auto& submap : map.published()->submaps()) {
    for (const auto& t : testing::TrianglesInMap(*submap)) {
      for (const double u : {0.1, 0.5}) {
        for (const double v : {0.1, 0.4})
          samples.emplace_back(submap->id(), t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]));
      }
    }
  }
  const DistanceQuery distances(surfaces, {});
  const BodyQuery query(surfaces, kIgnoringUnknown);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> half(0.05, 0.35);
  int num_touching = 0, num_clear = 0, num_several = 0;
  for (int round = 0; round < 150; ++round) {
    const OrientedBox box{testing::RandomPose(random, 1.5), {half(random), half(random), half(random)}};
    const testing::Solid solid{.shape = testing::Solid::Shape::kBox, .center_m = {0, 0, 0}, .size_m = box.half_m};
    const Transform T_box_map = box.T_world_box.inverse();
    double least_m = std::numeric_limits<double>::infinity();
    std::set<SubmapId> touched;
    for (const auto& [id, p] : samples) {
      const double d = solid.Distance(T_box_map * p);
      least_m = std::min(least_m, d);
      if (d < 0) touched.insert(id);
    }
    const bool is_inside = distances.At(box.T_world_box.translation()).distance_m < 0;
    const bool is_colliding = query.Test(box).is_colliding;
    const BodyAnswer checked = query.Check(box, 10);
    EXPECT_EQ(checked.is_colliding, is_colliding);
    if (least_m < 0 || is_inside) {
      EXPECT_TRUE(is_colliding);
    }
    if (least_m > kSceneVoxel_m && !is_inside) {
      EXPECT_FALSE(is_colliding);
    }
    for (const SubmapId id : touched) {
      EXPECT_TRUE(std::any_of(checked.contacts.begin(), checked.contacts.end(),
                              [&](const BodyContact& c) { return c.submap->id == id; }));
    }
    for (std::size_t i = 1; i < checked.contacts.size(); ++i) {
      EXPECT_GE(checked.contacts[i - 1].depth_m, checked.contacts[i].depth_m);
    }
    ++(is_colliding ? num_touching : num_clear);
    num_several += checked.contacts.size() > 1;
  }
  EXPECT_GT(num_touching, 20);
  EXPECT_GT(num_clear, 20);
  EXPECT_GT(num_several, 0);
}

TEST(BodyQuery, TellsAllObjectsOfASphereTheNearestFirst) {
  Map map(testing::SceneInfo());
  for (const double x : {-0.5, 0.6, 3.0}) {
    testing::ObserveBand(testing::AddThing(map), testing::Ball({x, 0, 0}, 0.3), testing::CubeAt({x, 0, 0}, 0.5));
  }
  const auto surfaces = SurfacesOf(map);
  const BodyQuery query(surfaces, kIgnoringUnknown);
  const BodyAnswer all = query.Check(Sphere({0, 0, 0}, 0.35), 10);
  ASSERT_EQ(all.contacts.size(), 2u);
  EXPECT_EQ(all.contacts[0].submap->id, SubmapId(1));
  EXPECT_EQ(all.contacts[1].submap->id, SubmapId(2));
  EXPECT_NEAR(all.contacts[0].depth_m, 0.15, 0.1 * kSceneVoxel_m);
  EXPECT_NEAR(all.contacts[1].depth_m, 0.05, 0.1 * kSceneVoxel_m);
  EXPECT_EQ(query.Check(Sphere({0, 0, 0}, 0.35), 1).contacts.size(), 1u);
}

TEST(BodyQuery, PaddingIsAsIfTheBodyWereLarger) {
  Map map = MovedRoom();
  const auto surfaces = SurfacesOf(map);
  BodyOptions padded = kIgnoringUnknown;
  padded.scope.padding = {.default_m = 0.1, .classes = {}, .submaps = {{SubmapId(4), 0.1}}};
  const BodyQuery a(surfaces, padded), b(surfaces, kIgnoringUnknown);
  std::mt19937 random(9);
  for (const Eigen::Vector3d& p : testing::RandomPoints(150, 1.4, 31)) {
    EXPECT_EQ(a.Test(Sphere(p, 0.1)).is_colliding, b.Test(Sphere(p, 0.2)).is_colliding);
    const Capsule thin{p, 0.8 * p, 0.02}, thick{p, 0.8 * p, 0.12};
    EXPECT_EQ(a.Test(thin).is_colliding, b.Test(thick).is_colliding);
    const OrientedBox box{testing::RandomPose(random, 1.2), {0.05, 0.1, 0.02}};
    const OrientedBox larger{box.T_world_box, box.half_m + Eigen::Vector3d::Constant(0.1)};
    if (b.Test(box).is_colliding) {
      EXPECT_TRUE(a.Test(box).is_colliding);
    }
    if (!b.Test(larger).is_colliding) {
      EXPECT_FALSE(a.Test(box).is_colliding) << "round corners are less";
    }
  }
}

TEST(BodyQuery, ABodyWhollyInsideAThingCollidesWithIt) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.7), testing::CubeAt({0, 0, 0}, 0.9));
  const BodyQuery query(SurfacesOf(map), kIgnoringUnknown);
  const Body bodies[] = {Sphere({0.1, 0, 0}, 0.05), Capsule{{0, 0, 0.1}, {0, 0.1, 0}, 0.05},
                         OrientedBox{Transform::Identity(), {0.1, 0.1, 0.1}}};
  for (const Body& body : bodies) {
    EXPECT_TRUE(query.Test(body).is_colliding);
    ASSERT_EQ(query.Check(body).contacts.size(), 1u);
    EXPECT_EQ(query.Check(body).contacts[0].submap->id, SubmapId(1));
    EXPECT_GT(query.Check(body).contacts[0].depth_m, 0.5);
  }
}

/// A map in which half of the voxels near the origin were looked through, in no order.
Map SpeckledSpace() {
  Map map(testing::SceneInfo());
  std::mt19937_64 random(13);
  for (int z = -1; z <= 0; ++z) {
    for (int y = -1; y <= 0; ++y) {
      for (int x = -1; x <= 0; ++x) {
        FreeBlocks seen;
        for (int cell = 0; cell < kTileBlocks; ++cell) {
          if (random() % 3 == 0) {
            seen.full |= std::uint64_t{1} << cell;
            continue;
          }
          seen.mixed |= std::uint64_t{1} << cell;
          for (auto& word : seen.masks[static_cast<std::size_t>(cell)]) word = random() | random() | random() | 1;
          seen.masks[static_cast<std::size_t>(cell)][0] &= ~std::uint64_t{2};
        }
        map.mutable_free_space().Add({x, y, z}, seen, 1);
      }
    }
  }
  return map;
}

TEST(VisitUnseen, VisitsWhatABodyHoldsAndNobodyHasSeen) {
  Map map = SpeckledSpace();
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0.3, 0, 0}, 0.3), testing::CubeAt({0.3, 0, 0}, 0.5));
  const auto surfaces = SurfacesOf(map);
  const QueryWorld world(surfaces, {});
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::size_t num_found = 0;
  for (int round = 0; round < 60; ++round) {
    const Capsule capsule{{unit(random), unit(random), unit(random)},
                          {unit(random), unit(random), unit(random)},
                          0.15 + 0.1 * unit(random)};
    const Capsule ball{capsule.a_m, capsule.a_m, 0.2};
    const OrientedBox box{testing::RandomPose(random, 0.8), {0.3, 0.05, 0.2}};
    const auto expect_equal = [&](const auto& body, const auto& holds) {
      std::set<VoxelIndex> expected, found;
      const Eigen::AlignedBox3d bounds = BoundsOf(body);
      const VoxelIndex low = VoxelAt(bounds.min(), kSceneVoxel_m), high = VoxelAt(bounds.max(), kSceneVoxel_m);
      for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
          for (int x = low.x; x <= high.x; ++x) {
            const VoxelIndex voxel{x, y, z};
            if (holds(VoxelCentre(voxel, kSceneVoxel_m)) && !world.IsSeen(voxel)) expected.insert(voxel);
          }
        }
      }
      VisitUnseen(world, body, [&](VoxelIndex voxel) {
        EXPECT_TRUE(found.insert(voxel).second) << "once each";
        return true;
      });
      EXPECT_EQ(found, expected);
      num_found += found.size();
    };
    const auto in_capsule = [](const Capsule& c) {
      return [c](const Eigen::Vector3d& p) {
        const Eigen::Vector3d axis = c.b_m - c.a_m;
        const double along = std::clamp((p - c.a_m).dot(axis) / std::max(axis.squaredNorm(), 1e-30), 0.0, 1.0);
        return (p - c.a_m - along * axis).norm() <= c.radius_m;
      };
    };
    expect_equal(capsule, in_capsule(capsule));
    expect_equal(ball, in_capsule(ball));
    expect_equal(box, [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d in_box = box.T_world_box.inverse() * p;
      return (in_box.cwiseAbs() - box.half_m).maxCoeff() <= 0;
    });
  }
  EXPECT_GT(num_found, 1000u);
}

TEST(VisitUnseen, FindsTheVoxelThatAPointIsInAndEndsBeyondTheGrid) {
  Map map(testing::SceneInfo());
  const QueryWorld world(SurfacesOf(map), {});
  for (const double far : {0.0, 1e5, 1e12, 1e300}) {
    int num_found = 0;
    const Eigen::Vector3d p(far, 0.01, -far);
    VisitUnseen(world, Capsule{p, p, 0}, [&](VoxelIndex) { return ++num_found < 50; });
    EXPECT_GE(num_found, 1) << far;
  }
}

TEST(BodyQuery, UnseenSpaceIsInTheWayUnlessAskedOtherwise) {
  Map map(testing::SceneInfo());
  FreeBlocks seen;
  seen.full = ~std::uint64_t{0};  // 0 to 1.6 m
  map.mutable_free_space().Add({0, 0, 0}, seen, 1);
  const auto surfaces = SurfacesOf(map);
  const BodyQuery occupied(surfaces, {}), reported(surfaces, {.unknown = UnknownSpace::kReported}),
      free(surfaces, kIgnoringUnknown);
  const Body known = Sphere({0.5, 0.5, 0.5}, 0.4), unknown = Sphere({0.5, 0.5, 0.3}, 0.4);
  for (const BodyQuery* query : {&occupied, &reported, &free}) {
    EXPECT_FALSE(query->Test(known).is_colliding);
    EXPECT_FALSE(query->Check(known).is_unknown);
  }
  EXPECT_TRUE(occupied.Test(unknown).is_colliding);
  EXPECT_TRUE(occupied.Test(unknown).is_unknown);
  EXPECT_FALSE(reported.Test(unknown).is_colliding);
  EXPECT_TRUE(reported.Test(unknown).is_unknown);
  EXPECT_FALSE(free.Test(unknown).is_colliding);
  EXPECT_FALSE(free.Test(unknown).is_unknown);
  ASSERT_EQ(occupied.Check(unknown).contacts.size(), 1u);
  EXPECT_EQ(occupied.Check(unknown).contacts[0].submap, nullptr);
  EXPECT_LT(occupied.Check(unknown).contacts[0].point_m.z(), 0);
}

TEST(BodyQuery, WhatIsAttachedLeavesSpaceThatIsKnown) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.4), testing::CubeAt({0, 0, 0}, 0.6));
  BodyOptions options;
  const Body inside = Sphere({0.05, 0, 0}, 0.3);
  EXPECT_EQ(BodyQuery(SurfacesOf(map), options).Check(inside).contacts[0].submap->id, SubmapId(1));
  options.scope.attached = {SubmapId(1)};
  EXPECT_FALSE(BodyQuery(SurfacesOf(map), options).Check(inside).is_colliding);
  EXPECT_TRUE(BodyQuery(SurfacesOf(map), options).Check(Sphere({0, 0, 0}, 0.8)).is_unknown) << "around it";
  options.scope.attached.clear();
  options.scope.excluded_submaps = {SubmapId(1)};
  EXPECT_TRUE(BodyQuery(SurfacesOf(map), options).Check(inside).is_unknown) << "as if it had never been there";
}

}  // namespace
}  // namespace dhpmap
