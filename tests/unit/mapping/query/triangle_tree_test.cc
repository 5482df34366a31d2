// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/triangle_tree.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

std::vector<TriangleCorners> RandomTriangles(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1, 1), size(-0.1f, 0.1f);
  const auto vector = [&random](auto& range) { return Eigen::Vector3f(range(random), range(random), range(random)); };
  std::vector<TriangleCorners> triangles;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f a = vector(place);
    triangles.push_back({a, a + vector(size), i % 50 == 0 ? a : Eigen::Vector3f(a + vector(size))});
  }
  return triangles;
}

std::array<Eigen::Vector3d, 3> InDoubles(const TriangleCorners& t) {
  return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
}

TEST(TriangleTree, FindsTheNearestPointOfAllTriangles) {
  for (const int count : {1, 10, 3000}) {
    const auto triangles = RandomTriangles(count, static_cast<unsigned>(count));
    const TriangleTree tree(triangles);
    for (const Eigen::Vector3d& p : testing::RandomPoints(300, 1.5, 4)) {
      double truth = 1e9;
      for (const auto& t : triangles) truth = std::min(truth, testing::DistanceToTriangle(p, InDoubles(t)));
      NearestSurface best{.distance2_m2 = 100};
      ASSERT_TRUE(tree.ImproveNearest(p.cast<float>(), best));
      EXPECT_NEAR(std::sqrt(best.distance2_m2), truth, 1e-4);
      EXPECT_NEAR((p - best.point_m.cast<double>()).norm(), truth, 1e-4);
    }
  }
}

TEST(TriangleTree, SaysNothingBeyondTheLimit) {
  const TriangleTree tree({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  NearestSurface best{.distance2_m2 = 0.25f};
  EXPECT_FALSE(tree.ImproveNearest({0.2f, 0.2f, 0.51f}, best));
  EXPECT_TRUE(tree.ImproveNearest({0.2f, 0.2f, 0.49f}, best));
  EXPECT_GT(best.side, 0);
}

TEST(TriangleTree, TellsTheSideOfAClosedSurfaceAlsoFromItsEdgesAndCorners) {
  // A tetrahedron with sharp edges: the nearest point of most points around is on an edge or a corner.
  const Eigen::Vector3f a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0.1f, 0.1f, 0.3f);
  const TriangleTree tree({{{a, c, b}}, {{a, b, d}}, {{b, c, d}}, {{c, a, d}}});
  int num_inside = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(20000, 1.2, 5)) {
    const Eigen::Vector3f q = p.cast<float>();
    NearestSurface best{.distance2_m2 = 100};
    ASSERT_TRUE(tree.ImproveNearest(q, best));
    bool is_inside = true;
    for (const auto& [u, v, w] : std::vector<TriangleCorners>{{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}}) {
      is_inside &= (v - u).cross(w - u).dot(q - u) < 0;
    }
    num_inside += is_inside;
    EXPECT_EQ(best.side < 0, is_inside) << p.transpose();
  }
  EXPECT_GT(num_inside, 10);
}

TEST(TriangleTree, OfNothingIsNowhere) {
  NearestSurface best{.distance2_m2 = 100};
  EXPECT_FALSE(TriangleTree({}).ImproveNearest({0, 0, 0}, best));
}

}  // namespace
}  // namespace dhpmap
