// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/octomap_file.h"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <random>
#include <sstream>

namespace dhpmap {
namespace {

using Cell = std::array<int, 3>;
using Cells = std::map<Cell, bool>;  // whether it is occupied

/// What OctoMap's own library reads.
std::unique_ptr<octomap::OcTree> Read(const std::string& bytes) {
  auto tree = std::make_unique<octomap::OcTree>(1.0);
  std::istringstream in(bytes);
  return tree->readBinary(in) ? std::move(tree) : nullptr;
}

std::string BytesOf(const Cells& cells, double resolution_m) {
  OctomapFile file;
  for (const auto& [cell, is_occupied] : cells) EXPECT_TRUE(file.Add(cell[0], cell[1], cell[2], is_occupied).ok());
  return file.Bytes(resolution_m);
}

/// Looks up each cell of a cube by its middle.
void ExpectSame(const octomap::OcTree& tree, const Cells& cells, int low, int high, double resolution_m) {
  const auto middle = [=](int index) { return (index + 0.5) * resolution_m; };
  for (int x = low; x < high; ++x) {
    for (int y = low; y < high; ++y) {
      for (int z = low; z < high; ++z) {
        const auto* node = tree.search(middle(x), middle(y), middle(z));
        const auto known = cells.find({x, y, z});
        ASSERT_EQ(node != nullptr, known != cells.end()) << x << " " << y << " " << z;
        if (node != nullptr) {
          ASSERT_EQ(tree.isNodeOccupied(node), known->second) << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(OctomapFile, SaysOfEachCellWhatItWasTold) {
  std::mt19937 random(7);
  constexpr int kLow = -9, kHigh = 9;
  for (const double share_known : {0.02, 0.5, 1.0}) {
    Cells cells;
    for (int x = kLow; x < kHigh; ++x) {
      for (int y = kLow; y < kHigh; ++y) {
        for (int z = kLow; z < kHigh; ++z) {
          if (std::bernoulli_distribution(share_known)(random)) cells[{x, y, z}] = x > y;
        }
      }
    }
    const auto tree = Read(BytesOf(cells, 0.05));
    ASSERT_NE(tree, nullptr);
    EXPECT_DOUBLE_EQ(tree->getResolution(), 0.05);
    ExpectSame(*tree, cells, kLow - 2, kHigh + 2, 0.05);
  }
}

TEST(OctomapFile, EightCellsThatAreTheSameAreOneLeaf) {
  Cells cells;
  for (int i = 0; i < 8; ++i) cells[{4 + (i & 1), 2 + (i >> 1 & 1), -2 + (i >> 2)}] = true;
  const auto tree = Read(BytesOf(cells, 0.25));
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(tree->getNumLeafNodes(), 1u);
  ExpectSame(*tree, cells, -4, 8, 0.25);
}

TEST(OctomapFile, OfNothingIsAFileToo) {
  const auto tree = Read(OctomapFile().Bytes(0.1));
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(tree->size(), 0u);
}

TEST(OctomapFile, ReachesAsFarAsOctoMapDoes) {
  OctomapFile file;
  constexpr int kEnd = OctomapFile::kReach;
  EXPECT_TRUE(file.Add(-kEnd, kEnd - 1, 0, true).ok());
  EXPECT_EQ(file.Add(kEnd, 0, 0, true).code(), StatusCode::kOutOfRange);
  EXPECT_EQ(file.Add(0, 0, -kEnd - 1, true).code(), StatusCode::kOutOfRange);
  const auto tree = Read(file.Bytes(0.5));
  ASSERT_NE(tree, nullptr);
  EXPECT_NE(tree->search((-kEnd + 0.5) * 0.5, (kEnd - 0.5) * 0.5, 0.25), nullptr);
}

}  // namespace
}  // namespace dhpmap
