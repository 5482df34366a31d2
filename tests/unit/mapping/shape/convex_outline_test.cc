// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/shape/convex_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace dhpmap {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> RandomPoints(std::mt19937& random, int num) {
  std::uniform_real_distribution<double> x(-3, 2), y(1, 2);
  std::vector<Vector2d> points;
  for (int i = 0; i < num; ++i) points.push_back(Vector2d{x(random), y(random)});
  return points;
}

double Side(const Vector2d& from, const Vector2d& to, const Vector2d& p) {
  const Vector2d along = to - from, away = p - from;
  return along.x() * away.y() - along.y() * away.x();
}

TEST(ConvexHull, HoldsAllPointsAndTurnsLeftAtEachOfThem) {
  std::mt19937 random(1);
  for (int num = 3; num < 60; ++num) {
    const std::vector<Vector2d> points = RandomPoints(random, num);
    const ConvexOutline hull = ConvexHull(points);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vector2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
      EXPECT_GT(Side(a, b, hull[(i + 2) % hull.size()]), 0);
      for (const Vector2d& p : points) EXPECT_GE(Side(a, b, p), -1e-12);
    }
  }
}

TEST(ConvexHull, LeavesOutWhatLiesBetweenCornersOrTwice) {
  const ConvexOutline hull = ConvexHull({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}, {0, 2}, {0, 1}, {1, 1}});
  EXPECT_EQ(hull, (ConvexOutline{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
}

TEST(ConvexHull, OfPointsOnALineIsItsEnds) {
  EXPECT_TRUE(ConvexHull({}).empty());
  EXPECT_EQ(ConvexHull({{1, 2}, {1, 2}}), (ConvexOutline{{1, 2}}));
  EXPECT_EQ(ConvexHull({{1, 1}, {3, 3}, {2, 2}}), (ConvexOutline{{1, 1}, {3, 3}}));
}

TEST(LeastRectangle, HasNoMoreAreaThanAnyOfManyAround) {
  std::mt19937 random(2);
  for (int repetition = 0; repetition < 50; ++repetition) {
    const ConvexOutline hull = ConvexHull(RandomPoints(random, 20));
    const Rectangle least = LeastRectangle(hull);
    const Vector2d upward(-least.across.y(), least.across.x());
    EXPECT_NEAR(least.across.norm(), 1, 1e-12);
    EXPECT_GE(least.size.x(), least.size.y());
    for (const Vector2d& corner : hull) {
      EXPECT_LE(std::abs(least.across.dot(corner - least.center)), least.size.x() / 2 + 1e-12);
      EXPECT_LE(std::abs(upward.dot(corner - least.center)), least.size.y() / 2 + 1e-12);
    }
    for (int step = 0; step < 1000; ++step) {
      const double angle = step * std::numbers::pi / 2000;
      const Vector2d along(std::cos(angle), std::sin(angle)), aside(-along.y(), along.x());
      Vector2d low(1e9, 1e9), high(-1e9, -1e9);
      for (const Vector2d& corner : hull) {
        low = low.cwiseMin(Vector2d(along.dot(corner), aside.dot(corner)));
        high = high.cwiseMax(Vector2d(along.dot(corner), aside.dot(corner)));
      }
      EXPECT_LE(least.size.prod(), (high - low).prod() + 1e-12);
    }
  }
}

TEST(LeastRectangle, OfATurnedRectangleIsIt) {
  for (const double degrees : {-80.0, -30.0, 0.0, 17.0, 90.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vector2d along(std::cos(angle), std::sin(angle)), aside(-along.y(), along.x()), center(5, -2);
    std::vector<Vector2d> corners;
    for (const double a : {-1.5, 1.5})
      for (const double b : {-0.5, 0.5}) corners.push_back(center + a * along + b * aside);
    const Rectangle least = LeastRectangle(ConvexHull(corners));
    EXPECT_TRUE(least.center.isApprox(center, 1e-12));
    EXPECT_NEAR(least.size.x(), 3, 1e-12);
    EXPECT_NEAR(least.size.y(), 1, 1e-12);
    EXPECT_NEAR(std::abs(least.across.dot(along)), 1, 1e-12);
    EXPECT_GE(least.across.x(), 0);
  }
}

TEST(LeastRectangle, OfALineOrAPointHasNoArea) {
  EXPECT_EQ(LeastRectangle({{1, 2}}).size, Vector2d(0, 0));
  const Rectangle line = LeastRectangle({{0, 0}, {3, 4}});
  EXPECT_NEAR(line.size.x(), 5, 1e-12);
  EXPECT_NEAR(line.size.y(), 0, 1e-12);
}

TEST(Intersection, HasThePointsThatAreInBoth) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-3, 2), y(1, 2);
  const auto is_in = [](const ConvexOutline& hull, const Vector2d& p) {
    for (std::size_t i = 0; i < hull.size(); ++i) {
      if (Side(hull[i], hull[(i + 1) % hull.size()], p) < 0) return false;
    }
    return hull.size() > 2;
  };
  for (int repetition = 0; repetition < 30; ++repetition) {
    const ConvexOutline a = ConvexHull(RandomPoints(random, 5)), b = ConvexHull(RandomPoints(random, 5));
    const ConvexOutline both = Intersection(a, b);
    for (int i = 0; i < 300; ++i) {
      const Vector2d p{x(random), y(random)};
      EXPECT_EQ(is_in(both, p), is_in(a, p) && is_in(b, p));
    }
  }
}

TEST(Intersection, OfWhatOnlyTouchesIsEmpty) {
  const ConvexOutline a = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, b = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  EXPECT_TRUE(Intersection(a, b).empty());
  EXPECT_TRUE(Intersection(a, {{5, 5}, {6, 5}, {6, 6}}).empty());
}

}  // namespace
}  // namespace dhpmap
