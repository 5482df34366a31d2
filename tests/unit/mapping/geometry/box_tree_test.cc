// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace dhpmap {
namespace {

std::vector<Eigen::AlignedBox3f> RandomBoxes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-5, 5), size(0, 1);
  std::vector<Eigen::AlignedBox3f> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f low{place(random), place(random), i % 7 == 0 ? 0.5f : place(random)};
    boxes.emplace_back(low, low + Eigen::Vector3f{size(random), size(random), size(random)});
  }
  return boxes;
}

/// The numbers below `count`, each once, in any order.
void ExpectEachOnce(std::span<const std::uint32_t> items, std::size_t count) {
  std::vector<std::uint32_t> sorted(items.begin(), items.end()), each(count);
  std::ranges::sort(sorted);
  std::iota(each.begin(), each.end(), 0);
  EXPECT_EQ(sorted, each);
}

/// Every box's position in the tree with its squared distance, found from the root downwards; and that no node is
/// farther than what is below it.
void Descend(const BoxTree& tree, const Eigen::Vector3f& p, std::uint32_t height, std::uint32_t node, float least2,
             std::map<std::uint32_t, float>& found) {
  if (height == 0) {
    EXPECT_TRUE(found.emplace(tree.items()[node], least2).second) << "twice";
    return;
  }
  float distance2[BoxTree::kLanes];
  const unsigned all = tree.ChildrenWithin(height, node, p, 1e30f, distance2);
  const unsigned near = tree.ChildrenWithin(height, node, p, 9, distance2);
  for (std::uint32_t lane = 0; lane < BoxTree::kLanes; ++lane) {
    EXPECT_EQ(near >> lane & 1, distance2[lane] <= 9);
    if ((all >> lane & 1) == 0) continue;
    EXPECT_GE(distance2[lane], least2);
    Descend(tree, p, height - 1, BoxTree::kLanes * node + lane, distance2[lane], found);
  }
}

TEST(BoxTree, TellsHowFarBoxesAndNodesAre) {
  for (const std::size_t count : {1u, 7u, 8u, 9u, 63u, 64u, 65u, 513u, 1000u}) {
    const auto boxes = RandomBoxes(count, static_cast<unsigned>(count));
    const BoxTree tree(boxes);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-8, 8);
    for (int n = 0; n < 20; ++n) {
      const Eigen::Vector3f p{place(random), place(random), place(random)};
      std::map<std::uint32_t, float> found;
      Descend(tree, p, tree.height(), 0, 0, found);
      ASSERT_EQ(found.size(), count);
      for (const auto& [item, distance2] : found) {
        EXPECT_NEAR(distance2, boxes[item].squaredExteriorDistance(p), 1e-4f);
      }
    }
  }
}

TEST(BoxTree, LeavesOfEightHoldAllBoxes) {
  for (const std::size_t count : {1u, 8u, 9u, 64u, 65u, 700u}) {
    const auto boxes = RandomBoxes(count, 200 + static_cast<unsigned>(count));
    const BoxTree tree(boxes, BoxTree::kLanes);
    for (const auto& box : RandomBoxes(30, 12)) {
      std::set<std::size_t> leaves;
      tree.VisitOverlapping(box, [&](std::size_t leaf) { EXPECT_TRUE(leaves.insert(leaf).second); });
      for (std::size_t at = 0; at < count; ++at) {
        if (boxes[tree.items()[at]].intersects(box)) {
          EXPECT_TRUE(leaves.contains(at / BoxTree::kLanes)) << count;
        }
      }
    }
  }
}

TEST(BoxTree, PutsWhatIsCloseTogetherIntoOneNode) {
  const auto boxes = RandomBoxes(4096, 8);
  const BoxTree tree(boxes);
  float sum = 0;
  for (std::size_t first = 0; first < boxes.size(); first += BoxTree::kLanes) {
    Eigen::AlignedBox3f node;
    for (std::size_t lane = 0; lane < BoxTree::kLanes; ++lane) node.extend(boxes[tree.items()[first + lane]].center());
    sum += node.sizes().maxCoeff();
  }
  EXPECT_LT(sum / 512, 2) << "of ten: 512 equal cubes would have sides of 1.25";
}

TEST(BoxTree, CutsALineIntoPiecesInWhateverOrderItsBoxesCome) {
  constexpr int kCount = 100'000;
  using Place = std::function<int(int)>;
  const std::vector<Place> orders = {
      [](int i) { return i; },
      [](int i) { return -i; },
      [](int i) { return std::abs(i - kCount / 2); },  // out and back, so that each place comes twice
      [](int i) { return -std::abs(i - kCount / 2); },
      [](int i) { return i % 2 == 0 ? i : -i; },
      [](int i) { return i % 317; },
      [](int i) { return i * 7919 % kCount; },
  };
  for (const Place& place : orders) {
    std::vector<Eigen::AlignedBox3f> boxes;
    boxes.reserve(kCount);
    for (int i = 0; i < kCount; ++i) boxes.emplace_back(Eigen::Vector3f(static_cast<float>(place(i)), -0.0f, 0.0f));
    const BoxTree tree(boxes);
    float behind = -std::numeric_limits<float>::infinity();
    for (std::size_t first = 0; first < kCount; first += BoxTree::kLanes) {
      Eigen::AlignedBox3f node;
      for (std::size_t lane = 0; lane < BoxTree::kLanes; ++lane) node.extend(boxes[tree.items()[first + lane]]);
      ASSERT_GE(node.min().x(), behind);
      behind = node.max().x();
    }
    ExpectEachOnce(tree.items(), kCount);
  }
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
  ExpectEachOnce(tree.items(), same.size());
}

TEST(BoxTree, OfNothingFindsNothing) {
  const BoxTree tree;
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(tree.height(), 0u);
  tree.VisitOverlapping({Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 1, 1)}, [](std::size_t) { throw 1; });
}

TEST(BoxTree, EverythingIsFarFromAPointBeyondAllNumbers) {
  const BoxTree tree(RandomBoxes(20, 1));
  for (const float far : {1e30f, std::numeric_limits<float>::infinity()}) {
    float distance2[BoxTree::kLanes];
    EXPECT_EQ(tree.ChildrenWithin(tree.height(), 0, {far, -far, 0}, 1e6f, distance2), 0u);
  }
}

}  // namespace
}  // namespace dhpmap
