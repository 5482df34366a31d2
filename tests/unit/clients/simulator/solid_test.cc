// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clients/simulator/bounding_tree.h"
#include "clients/simulator/random.h"

namespace dhpmap::simulator {
namespace {

constexpr double kTouching_m = 1e-9;
constexpr double kExact_m = 1e-6;

Eigen::Vector3d RandomPoint(Random& random, double reach_m) {
  return {random.Uniform(-reach_m, reach_m), random.Uniform(-reach_m, reach_m), random.Uniform(-reach_m, reach_m)};
}

/// Every shape, turned and shifted.
std::vector<Solid> AllShapes() {
  Random random(1, 0, 0);
  std::vector<Solid> solids;
  const auto add = [&](Solid::Shape shape, const Eigen::Vector3d& size_m, double radius_m) {
    Solid solid;
    solid.shape = shape;
    solid.size_m = size_m;
    solid.radius_m = radius_m;
    solid.center_m = RandomPoint(random, 0.3);
    solid.R_map_solid = Eigen::AngleAxisd(random.Uniform(0, 3), RandomPoint(random, 1).normalized()).toRotationMatrix();
    solids.push_back(solid);
  };
  add(Solid::Shape::kBox, {0.5, 0.3, 0.2}, 0);
  add(Solid::Shape::kBox, {0.5, 0.3, 0.2}, 0.08);
  add(Solid::Shape::kBox, {0.5, 0.3, 0.2}, 0.1999);
  add(Solid::Shape::kSphere, {1, 1, 1}, 0.4);
  add(Solid::Shape::kCylinder, {1, 1, 0.4}, 0.25);
  add(Solid::Shape::kCapsule, {1, 1, 0.4}, 0.15);
  add(Solid::Shape::kCone, {0.4, 0.1, 0.3}, 0);
  add(Solid::Shape::kCone, {0.1, 0.4, 0.3}, 0);
  add(Solid::Shape::kTorus, {0.4, 1, 1}, 0.1);
  return solids;
}

/// The slow way: steps of the distance, which never go too far.
double March(const Solid& solid, const Ray& ray, double max_m) {
  double t = 0;
  for (int step = 0; step < 20000 && t < max_m; ++step) {
    const double distance = solid.Distance(ray.At(t));
    if (distance < kTouching_m) return t;
    t += distance;
  }
  return kFar_m;
}

TEST(Solid, RaysMeetTheSurfaceWhereTheDistanceSays) {
  Random random(2, 0, 0);
  for (const Solid& solid : AllShapes()) {
    int num_hits = 0;
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d eye = 3 * RandomPoint(random, 1).normalized(), target = RandomPoint(random, 0.8);
      const Ray ray{eye, (target - eye).normalized()};
      const double marched_m = March(solid, ray, 8);
      const std::optional<double> t = solid.Intersect(ray, 8);
      const Eigen::Vector3d p = ray.At(t.value_or(marched_m));
      if (t.has_value() != (marched_m < 8)) {
        // Only where the ray just touches may the two disagree.
        EXPECT_LT(std::abs(solid.Distance(p)), kExact_m);
        EXPECT_LT(std::abs(solid.Normal(p).dot(ray.direction)), 0.01) << static_cast<int>(solid.shape);
        continue;
      }
      if (!t) continue;
      ++num_hits;
      const double slant = std::max(1e-3, -solid.Normal(p).dot(ray.direction));
      EXPECT_NEAR(*t, marched_m, kExact_m / slant) << static_cast<int>(solid.shape);
      EXPECT_FALSE(solid.Intersect(ray, *t - 0.01)) << "what is nearer than the surface is empty";
    }
    EXPECT_GT(num_hits, 200) << static_cast<int>(solid.shape);
  }
}

TEST(Solid, RaysFromInsideMeetNothing) {
  for (const Solid& solid : AllShapes()) {
    Eigen::Vector3d inside = solid.center_m;
    if (solid.shape == Solid::Shape::kTorus) inside += solid.R_map_solid.col(0) * solid.size_m.x();
    ASSERT_LT(solid.Distance(inside), 0);
    const Eigen::Vector3d along =
        solid.shape == Solid::Shape::kTorus ? solid.R_map_solid.col(2).eval() : Eigen::Vector3d(0.36, 0.48, 0.8);
    EXPECT_FALSE(solid.Intersect({inside, along}, kFar_m)) << static_cast<int>(solid.shape);
  }
}

TEST(Solid, NormalIsTheSlopeOfTheDistance) {
  constexpr double kStep_m = 1e-5;
  Random random(3, 0, 0);
  for (const Solid& solid : AllShapes()) {
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d eye = 3 * RandomPoint(random, 1).normalized();
      const Ray ray{eye, (RandomPoint(random, 0.4) - eye).normalized()};
      const std::optional<double> t = solid.Intersect(ray, 8);
      if (!t) continue;
      // A little outside, and not where two faces meet, whose normals both are right.
      const Eigen::Vector3d p = ray.At(*t) + 1e-4 * solid.Normal(ray.At(*t));
      Eigen::Vector3d slope;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(axis);
        slope[axis] = (solid.Distance(p + step) - solid.Distance(p - step)) / (2 * kStep_m);
      }
      if (slope.norm() < 0.999) continue;
      EXPECT_LT((slope - solid.Normal(ray.At(*t))).norm(), 0.02) << static_cast<int>(solid.shape);
    }
  }
}

TEST(Solid, BoundsHoldTheSurfaceClosely) {
  Random random(4, 0, 0);
  for (const Solid& solid : AllShapes()) {
    const Eigen::AlignedBox3d bounds = solid.Bounds();
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d eye = 3 * RandomPoint(random, 1).normalized();
      const Ray ray{eye, (solid.center_m - eye).normalized()};
      const std::optional<double> t = solid.Intersect(ray, 8);
      if (!t) continue;
      EXPECT_LT(bounds.exteriorDistance(ray.At(*t)), 1e-6);
    }
    EXPECT_LT(bounds.sizes().maxCoeff(), 2 * std::sqrt(3.0) * 0.65);
  }
}

TEST(BoundingTree, FindsTheSameAsLookingAtAllSolids) {
  Random random(5, 0, 0);
  std::vector<Solid> solids;
  for (int copy = 0; copy < 12; ++copy) {
    for (Solid solid : AllShapes()) {
      solid.center_m += RandomPoint(random, 4);
      solid.instance = static_cast<std::uint8_t>(solids.size() + 1);
      solids.push_back(solid);
    }
  }
  const BoundingTree tree(solids);
  int num_hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{RandomPoint(random, 6), RandomPoint(random, 1).normalized()};
    double first_m = 20, nearest_m = kFar_m;
    int first = 0, nearest = 0;
    for (const Solid& solid : solids) {
      if (const std::optional<double> t = solid.Intersect(ray, first_m)) {
        first_m = *t;
        first = solid.instance;
      }
      if (solid.Distance(ray.origin_m) < nearest_m) {
        nearest_m = solid.Distance(ray.origin_m);
        nearest = solid.instance;
      }
    }
    const BoundingTree::Hit hit = tree.Cast(ray, 20);
    EXPECT_EQ(hit.solid == nullptr ? 0 : hit.solid->instance, first);
    EXPECT_DOUBLE_EQ(hit.distance_m, first_m);
    num_hits += first != 0;
    if (nearest_m < 0) continue;  // inside several, any of them will do
    const BoundingTree::Nearest closest = tree.Closest(ray.origin_m);
    EXPECT_DOUBLE_EQ(closest.distance_m, nearest_m);
    EXPECT_EQ(closest.solid->instance, nearest);
  }
  EXPECT_GT(num_hits, 200);
}

TEST(BoundingTree, WithoutSolidsSeesNothing) {
  const BoundingTree tree({});
  EXPECT_EQ(tree.Cast({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, 10).solid, nullptr);
  EXPECT_EQ(tree.Closest(Eigen::Vector3d::Zero()).solid, nullptr);
}

}  // namespace
}  // namespace dhpmap::simulator
