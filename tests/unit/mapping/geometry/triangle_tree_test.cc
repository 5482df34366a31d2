// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/triangle_tree.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

std::vector<TriangleCorners> RandomTriangles(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1, 1), size(-0.1f, 0.1f);
  const auto vector = [&random](auto& range) { return Eigen::Vector3f{range(random), range(random), range(random)}; };
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

TEST(TriangleTree, ThePointOfATriangleThatIsNearestIsOnItAndAsFarAsTheTriangle) {
  for (const TriangleCorners& triangle : RandomTriangles(400, 6)) {
    const auto exact = InDoubles(triangle);
    for (const Eigen::Vector3d& around : testing::RandomPoints(30, 0.3, 4)) {
      const Eigen::Vector3d p = exact[0] + around;
      const Eigen::Vector3d nearest = NearestPointOf(triangle, p.cast<float>()).cast<double>();
      EXPECT_NEAR((p - nearest).norm(), testing::DistanceToTriangle(p, exact), 1e-4);
      EXPECT_NEAR(testing::DistanceToTriangle(nearest, exact), 0, 1e-5);
    }
  }
}

TEST(TrianglePacket, MeasuresEightAtOnceAsEachAlone) {
  const auto triangles = RandomTriangles(400, 9);
  for (std::size_t first = 0; first < triangles.size(); first += TrianglePacket::kLanes) {
    const std::size_t count = first % 24 == 0 ? 5 : TrianglePacket::kLanes;  // some are not full
    TrianglePacket packet;
    for (std::size_t lane = 0; lane < count; ++lane) packet.Set(lane, triangles[first + lane]);
    for (const Eigen::Vector3d& around : testing::RandomPoints(40, 0.4, 5)) {
      const Eigen::Vector3f p = triangles[first][0] + around.cast<float>();
      float distance2[TrianglePacket::kLanes];
      const unsigned within = packet.Within(p, 0.5f, distance2);
      EXPECT_EQ(within >> count, 0u) << "lanes without a triangle";
      for (std::size_t lane = 0; lane < count; ++lane) {
        const auto exact = InDoubles(triangles[first + lane]);
        EXPECT_EQ(packet.Get(lane), triangles[first + lane]);
        if ((exact[1] - exact[0]).cross(exact[2] - exact[0]).norm() < 1e-6) continue;  // what it says of these is free
        const double truth_m = testing::DistanceToTriangle(p.cast<double>(), exact);
        EXPECT_NEAR(std::sqrt(distance2[lane]), truth_m, 1e-5);
        EXPECT_EQ((within >> lane & 1u) != 0, distance2[lane] <= 0.5f);
      }
    }
  }
}

TEST(TrianglePacket, FindsAlongARayEveryTriangleWhoseBoxItMeets) {
  const auto triangles = RandomTriangles(400, 10);
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  int num_met = 0, num_missed = 0;
  for (std::size_t first = 0; first < triangles.size(); first += TrianglePacket::kLanes) {
    TrianglePacket packet;
    for (std::size_t lane = 0; lane < TrianglePacket::kLanes; ++lane) packet.Set(lane, triangles[first + lane]);
    for (std::size_t aimed_at = 0; aimed_at < TrianglePacket::kLanes; ++aimed_at) {
      const auto& [a, b, c] = triangles[first + aimed_at];
      const Eigen::Vector3f target = 0.3f * a + 0.3f * b + 0.4f * c;
      Eigen::Vector3f direction = Eigen::Vector3f{normal(random), normal(random), normal(random)}.normalized();
      if (aimed_at == 3) direction = Eigen::Vector3f(1e-12f, 1, 1e-12f);  // along an axis
      const Eigen::Vector3f origin = target - 2 * direction;
      const unsigned near = packet.Along(origin, direction.cwiseInverse(), 1e-5f, 1.5f);
      const unsigned far = packet.Along(origin, direction.cwiseInverse(), 1e-5f, 2.5f);
      EXPECT_NE(far >> aimed_at & 1u, 0u);
      const bool reaches_back = (a - b).norm() + (b - c).norm() > 0.5f;
      EXPECT_TRUE(reaches_back || (near >> aimed_at & 1u) == 0);
      num_met += std::popcount(far);
      num_missed += 8 - std::popcount(far);
    }
  }
  EXPECT_GT(num_missed, 3 * num_met) << "few of the others are met";
}

TEST(TriangleTree, KeepsEveryTriangleWhereItsTreeSays) {
  const auto triangles = RandomTriangles(500, 7);
  const TriangleTree tree(triangles);
  ASSERT_EQ(tree.num_triangles(), triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    EXPECT_EQ(tree.triangle(i), triangles[tree.tree().items()[i]]);
    for (const Eigen::Vector3f& corner : tree.triangle(i)) EXPECT_TRUE(tree.bounds().contains(corner));
  }
  EXPECT_EQ(TriangleTree(std::vector<TriangleCorners>{}).num_triangles(), 0u);
}

}  // namespace
}  // namespace dhpmap
