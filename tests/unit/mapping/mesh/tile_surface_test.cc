// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "mapping/mesh/mesh.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

using testing::kVoxel_m;

/// The grid edges that the corners are on, whatever comes first: twice the voxel's number, between two the odd one.
using Key = std::array<std::array<long, 3>, 3>;
Key KeyOf(const std::array<Eigen::Vector3d, 3>& triangle) {
  Key key;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double voxel = triangle[i][static_cast<Eigen::Index>(axis)] / kVoxel_m - 0.5;
      const bool is_centre = std::abs(voxel - std::round(voxel)) < 1e-4;  // between two it is farther
      key[i][axis] = is_centre ? 2 * std::lround(voxel) : 2 * std::lround(std::floor(voxel)) + 1;
    }
  }
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

using Triangle = std::array<Eigen::Vector3d, 3>;
std::vector<Triangle> TrianglesOf(const Submap& submap) {
  std::vector<Triangle> triangles;
  for (const TileEntry& tile : submap.blocks().tiles()) {
    const Eigen::Vector3d corner = TileCorner(tile.index, kVoxel_m);
    for (const SurfaceTriangle& t :
         ExtractTileSurface(FindBlocks(FindNeighbourhood(submap.blocks(), tile.index), tile.index), kVoxel_m)) {
      triangles.push_back({corner + t[0].cast<double>(), corner + t[1].cast<double>(), corner + t[2].cast<double>()});
    }
  }
  return triangles;
}

std::multiset<Key> KeysOf(const std::vector<Triangle>& triangles) {
  std::multiset<Key> keys;
  for (const Triangle& triangle : triangles) keys.insert(KeyOf(triangle));
  return keys;
}

std::vector<Triangle> MeshOf(const Submap& submap) {
  std::vector<Triangle> triangles;
  const Mesh mesh = ExtractMesh(submap, LabelSet(), MeshColoring::kSensor);
  for (const auto& t : mesh.triangles) {
    triangles.push_back({mesh.vertices_m[t[0]].cast<double>(), mesh.vertices_m[t[1]].cast<double>(),
                         mesh.vertices_m[t[2]].cast<double>()});
  }
  return triangles;
}

/// Every corner is within a hundredth of a voxel of where the distance is zero.
void ExpectOnSurface(const std::vector<Triangle>& triangles, const testing::DistanceFunction& distance) {
  for (const Triangle& triangle : triangles) {
    for (const Eigen::Vector3d& corner : triangle) EXPECT_NEAR(distance(corner), 0, 0.01 * kVoxel_m);
  }
}

TEST(TileSurface, IsTheMeshWhereAllAroundIsObserved) {
  // Through eight tiles, with a block's room around: no cell at the border crosses the surface.
  const auto ball = testing::Sphere({0.11, -0.07, 0.05}, 1.3);
  const Submap submap = testing::SolidSubmap(ball, {-5, -5, -5}, {4, 4, 4});
  const auto surface = TrianglesOf(submap), mesh = MeshOf(submap);
  EXPECT_GT(mesh.size(), 1000u);
  EXPECT_TRUE(KeysOf(surface) == KeysOf(mesh)) << "each triangle once, facing the same way";
  ExpectOnSurface(surface, ball);
}

TEST(TileSurface, HoldsTheMeshAndReachesOneVoxelOverTheBorder) {
  const auto plane = [](const Eigen::Vector3d& p) { return p.z() - 0.21; };
  const Submap submap = testing::SolidSubmap(plane, {-1, 0, 0}, {0, 1, 0});  // 16 x 16 x 8 voxels from (-8, 0, 0) on
  const auto surface = TrianglesOf(submap);
  const auto keys = KeysOf(surface), mesh = KeysOf(MeshOf(submap));
  EXPECT_TRUE(std::includes(keys.begin(), keys.end(), mesh.begin(), mesh.end()));
  EXPECT_EQ(mesh.size(), 2u * 15 * 15);
  EXPECT_EQ(surface.size(), 2u * 17 * 17);
  ExpectOnSurface(surface, plane);
}

TEST(TileSurface, BordersOfOneSignAreExtrapolatedThroughTheSurface) {
  // Only what is in front has been observed, down to the voxels next to the surface.
  const auto plane = [](const Eigen::Vector3d& p) { return p.z() - 0.21; };
  Submap submap(testing::SolidInfo(), 1);
  TsdfBlock& block = submap.MutableTsdf({0, 0, 0});
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    const double d = plane(VoxelCentre(VoxelIn({0, 0, 0}, linear), kVoxel_m));
    if (d < 0) continue;
    block.distance_m[static_cast<std::size_t>(linear)] = static_cast<float>(d);
    block.weight[static_cast<std::size_t>(linear)] = 1;
  }
  EXPECT_TRUE(MeshOf(submap).empty());
  const auto surface = TrianglesOf(submap);
  EXPECT_EQ(surface.size(), 2u * 9 * 9);
  ExpectOnSurface(surface, plane);
}

TEST(TileSurface, OfASingleVoxelOrNothingIsNothing) {
  Submap submap(testing::SolidInfo(), 1);
  TsdfBlock& block = submap.MutableTsdf({0, 0, 0});
  EXPECT_TRUE(TrianglesOf(submap).empty());
  block.distance_m[9] = -0.01f;
  block.weight[9] = 1;
  EXPECT_TRUE(TrianglesOf(submap).empty());
}

}  // namespace
}  // namespace dhpmap
