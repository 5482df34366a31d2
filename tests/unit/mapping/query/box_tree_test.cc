// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/box_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace dhpmap {
namespace {

std::vector<Eigen::AlignedBox3f> RandomBoxes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-5, 5), size(0, 1);
  std::vector<Eigen::AlignedBox3f> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f low(place(random), place(random), i % 7 == 0 ? 0.5f : place(random));
    boxes.emplace_back(low, low + Eigen::Vector3f(size(random), size(random), size(random)));
  }
  return boxes;
}

TEST(BoxTree, FindsTheNearestBoxAndVisitsOnlyWhatMayBeNearer) {
  for (const std::size_t count : {1u, 7u, 8u, 9u, 63u, 64u, 65u, 513u, 1000u}) {
    const auto boxes = RandomBoxes(count, static_cast<unsigned>(count));
    const BoxTree tree(boxes);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-8, 8);
    for (int n = 0; n < 100; ++n) {
      const Eigen::Vector3f p(place(random), place(random), place(random));
      float truth = std::numeric_limits<float>::max();
      for (const auto& box : boxes) truth = std::min(truth, box.squaredExteriorDistance(p));
      float best = 1e6f;
      std::set<std::size_t> visited;
      tree.VisitNearest(p, best, [&](std::size_t position) {
        EXPECT_TRUE(visited.insert(position).second) << "twice";
        const float distance2 = boxes[tree.items()[position]].squaredExteriorDistance(p);
        EXPECT_LE(distance2, best * 1.0001f + 1e-6f);
        best = std::min(best, distance2);
        return best;
      });
      EXPECT_NEAR(best, truth, 1e-5f * (1 + truth)) << count;
    }
  }
}

TEST(BoxTree, KeepsToTheLimit) {
  const auto boxes = RandomBoxes(300, 5);
  const BoxTree tree(boxes);
  const Eigen::Vector3f p(1, 2, 3);
  constexpr float kLimit2 = 2.5f;
  std::set<std::uint32_t> visited, within;
  tree.VisitNearest(p, kLimit2, [&](std::size_t position) {
    visited.insert(tree.items()[position]);
    return kLimit2;
  });
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].squaredExteriorDistance(p) <= kLimit2) within.insert(i);
  }
  EXPECT_EQ(visited, within);
  EXPECT_FALSE(within.empty());
}

TEST(BoxTree, FindsAllThatOverlap) {
  for (const std::size_t count : {1u, 8u, 9u, 65u, 700u}) {
    const auto boxes = RandomBoxes(count, 100 + static_cast<unsigned>(count));
    const BoxTree tree(boxes);
    for (const auto& box : RandomBoxes(50, 9)) {
      std::multiset<std::uint32_t> found, truth;
      tree.VisitOverlapping(box, [&](std::size_t position) { found.insert(tree.items()[position]); });
      for (std::uint32_t i = 0; i < count; ++i) {
        if (boxes[i].intersects(box)) truth.insert(i);
      }
      EXPECT_EQ(found, truth);
    }
  }
}

TEST(BoxTree, HoldsEveryItemOnceAlsoWhereAllBoxesAreTheSame) {
  const std::vector<Eigen::AlignedBox3f> same(200,
                                              Eigen::AlignedBox3f(Eigen::Vector3f(1, 1, 1), Eigen::Vector3f(2, 2, 2)));
  const BoxTree tree(same);
  EXPECT_EQ(std::set<std::uint32_t>(tree.items().begin(), tree.items().end()).size(), 200u);
  std::size_t num_visited = 0;
  tree.VisitNearest({0, 0, 0}, 100, [&](std::size_t) {
    ++num_visited;
    return 100.0f;
  });
  EXPECT_EQ(num_visited, 200u);
}

TEST(BoxTree, OfNothingFindsNothing) {
  const BoxTree tree;
  EXPECT_TRUE(tree.empty());
  tree.VisitNearest({0, 0, 0}, 1, [](std::size_t) -> float { throw 1; });
  tree.VisitOverlapping({Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 1, 1)}, [](std::size_t) { throw 1; });
}

TEST(BoxTree, NothingIsNearAPointBeyondAllNumbers) {
  const BoxTree tree(RandomBoxes(20, 1));
  for (const float far : {1e30f, std::numeric_limits<float>::infinity()}) {
    tree.VisitNearest({far, -far, 0}, 9, [](std::size_t) -> float { throw 1; });
  }
}

}  // namespace
}  // namespace dhpmap
