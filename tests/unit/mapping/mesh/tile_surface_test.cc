// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/mesh/cell_cases.h"
#include "mapping/mesh/map_mesh.h"
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

TEST(TileSurface, IsTheMeshWhereTheObservedEnds) {
  const auto plane = [](const Eigen::Vector3d& p) { return p.z() - 0.21; };
  const Submap submap = testing::SolidSubmap(plane, {-1, 0, 0}, {0, 1, 0});  // 16 x 16 x 8 voxels from (-8, 0, 0) on
  const auto surface = TrianglesOf(submap);
  EXPECT_TRUE(KeysOf(surface) == KeysOf(MeshOf(submap)));
  EXPECT_EQ(surface.size(), 2u * 15 * 15);
  ExpectOnSurface(surface, plane);
}

TEST(TileSurface, IsNotWhereOnlyOneSideOfItWasSeen) {
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
  EXPECT_TRUE(TrianglesOf(submap).empty());
}

TEST(TileSurface, OfASingleVoxelOrNothingIsNothing) {
  Submap submap(testing::SolidInfo(), 1);
  TsdfBlock& block = submap.MutableTsdf({0, 0, 0});
  EXPECT_TRUE(TrianglesOf(submap).empty());
  block.distance_m[9] = -0.01f;
  block.weight[9] = 1;
  EXPECT_TRUE(TrianglesOf(submap).empty());
}

/// Surfaces from a few voxels here and there, some of them looked through: all distances as likely as any.
Submap Shreds(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> distance_m(-3 * kVoxel_m, 3 * kVoxel_m), unit(0, 1);
  const float roughness = unit(random), density = 0.2f + 0.8f * unit(random);
  Submap submap(testing::SolidInfo(), 1);
  for (int i = 0; i < 12; ++i) {
    const BlockIndex index{static_cast<int>(random() % 4) - 2, static_cast<int>(random() % 4) - 2,
                           static_cast<int>(random() % 4) - 2};
    TsdfBlock& block = submap.MutableTsdf(index);
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (unit(random) > density) continue;
      const Eigen::Vector3d p = VoxelCentre(VoxelIn(index, linear), kVoxel_m);
      const auto smooth = static_cast<float>(p.z() + 0.3 * p.x() - 0.02);
      const auto at = static_cast<std::size_t>(linear);
      block.distance_m[at] = random() % 20 == 0 ? 0 : smooth + roughness * distance_m(random);
      block.weight[at] = 1;
    }
    if (random() % 2 == 0) continue;
    GoneBlock& gone = submap.MutableGone(index);
    for (int k = 0; k < 100; ++k) gone.Set(static_cast<int>(random() % kBlockVoxels), static_cast<int>(random() % 4));
  }
  return submap;
}

/// The same surfaces from the definition, voxel by voxel.
class PlainSurface {
 public:
  explicit PlainSurface(const Submap& submap) : submap_(submap) {}

  [[nodiscard]] std::vector<Triangle> Triangles() const {
    std::vector<Triangle> triangles;
    for (int z = -20; z < 20; ++z) {
      for (int y = -20; y < 20; ++y) {
        for (int x = -20; x < 20; ++x) AddCell({x, y, z}, triangles);
      }
    }
    return triangles;
  }

 private:
  using Distance = std::optional<float>;

  [[nodiscard]] static VoxelIndex At(VoxelIndex v, int x, int y, int z) { return {v.x + x, v.y + y, v.z + z}; }
  [[nodiscard]] Distance Observed(VoxelIndex v) const {
    const BlockEntry* block = submap_.blocks().Find(BlockOf(v));
    const int linear = LinearIndex(v);
    if (block == nullptr || block->tsdf == nullptr || !block->Shows(linear)) return std::nullopt;
    return block->tsdf->distance_m[static_cast<std::size_t>(linear)];
  }
  void AddCell(VoxelIndex low, std::vector<Triangle>& triangles) const {
    std::array<float, kCellCorners> values;
    unsigned inside = 0;
    for (int c = 0; c < kCellCorners; ++c) {
      const VoxelIndex corner = At(low, c & 1, c >> 1 & 1, c >> 2 & 1);
      const Distance value = Observed(corner);
      if (!value) return;
      values[static_cast<std::size_t>(c)] = *value;
      inside |= *value < 0 ? 1u << c : 0;
    }
    const CellCase& cell_case = CellCases()[inside];
    for (std::size_t k = 0; k < cell_case.num_triangles; ++k) {
      Triangle& triangle = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const CellEdge edge = CellEdgeTable()[cell_case.triangles[k][i]];
        const float a = values[edge.corner], b = values[edge.corner | std::size_t{1} << edge.axis];
        triangle[i] = VoxelCentre(At(low, edge.corner & 1, edge.corner >> 1 & 1, edge.corner >> 2 & 1), kVoxel_m);
        triangle[i][edge.axis] += std::clamp(a / (a - b), 1e-3f, 1 - 1e-3f) * kVoxel_m;
      }
    }
  }

  const Submap& submap_;
};

TEST(TileSurface, OfWhateverIsLeftIsTheOneOfItsDefinition) {
  std::size_t num_triangles = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Submap submap = Shreds(seed);
    std::vector<Triangle> surface = TrianglesOf(submap), expected = PlainSurface(submap).Triangles();
    ASSERT_EQ(surface.size(), expected.size()) << "seed " << seed;
    const auto by_place = [](const Triangle& a, const Triangle& b) { return KeyOf(a) < KeyOf(b); };
    std::sort(surface.begin(), surface.end(), by_place);
    std::sort(expected.begin(), expected.end(), by_place);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      ASSERT_EQ(KeyOf(surface[i]), KeyOf(expected[i])) << "seed " << seed;
      for (const Eigen::Vector3d& corner : surface[i]) {
        const auto distance_m = [&](const Eigen::Vector3d& p) { return (p - corner).norm(); };
        const auto& there = expected[i];
        EXPECT_LT(std::min({distance_m(there[0]), distance_m(there[1]), distance_m(there[2])}), 1e-4 * kVoxel_m);
      }
    }
    num_triangles += surface.size();
  }
  EXPECT_GT(num_triangles, 1000u);
}

/// Shreds that belong to several submaps of a map, each voxel to one; some of them to the unknown submap.
Map ShredsOfSeveral(unsigned seed, std::uint32_t num_submaps) {
  MapInfo info;
  info.name = "m";
  info.config.voxel_size_m = kVoxel_m;
  Map map(info);
  for (std::uint32_t k = 1; k < num_submaps; ++k) (void)map.Create(testing::SolidInfo());
  const Submap whole = Shreds(seed);
  const unsigned coarseness = 1 + 3 * (seed % 4);
  for (const BlockEntry& entry : whole.blocks().entries()) {
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      const auto at = static_cast<std::size_t>(linear);
      if (!entry.tsdf->IsObserved(linear)) continue;
      const VoxelIndex v = VoxelIn(entry.index, linear);
      const auto patch = [&](int coordinate) { return static_cast<unsigned>(coordinate + 64) / coarseness; };
      const std::uint32_t owner = (patch(v.x) * 7 + patch(v.y) * 3 + patch(v.z) * 5) % num_submaps;
      Submap& submap = *map.FindMutable(SubmapId(owner));
      TsdfBlock& block = submap.MutableTsdf(entry.index);
      block.distance_m[at] = entry.tsdf->distance_m[at];
      block.weight[at] = 1;
      if (entry.IsContradicted(linear)) submap.MutableGone(entry.index).Set(linear, GoneBlock::kContradicted);
    }
  }
  return map;
}

/// Of all submaps of a map but one, which may be none of them.
std::vector<Triangle> SurfacesWithout(const MapSnapshot& map, SubmapId left_out) {
  std::vector<Triangle> triangles;
  for (const auto& submap : map.submaps()) {
    if (submap->id() == left_out) continue;
    for (const TileEntry& tile : submap->blocks().tiles()) {
      const auto owner = [&](const Submap& of) {
        return TileOwner{of.id(), FindBlocks(FindNeighbourhood(of.blocks(), tile.index), tile.index)};
      };
      std::vector<TileOwner> sharers;
      for (const auto& other : map.submaps()) {
        if (other != submap) sharers.push_back(owner(*other));
      }
      const TileSurface surface = ExtractTileSurface(owner(*submap), sharers, kVoxel_m);
      EXPECT_TRUE(surface.needs.empty() || surface.needs.size() == surface.triangles.size());
      const Eigen::Vector3d corner = TileCorner(tile.index, kVoxel_m);
      for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        if (!surface.needs.empty()) {
          const std::vector<SubmapId>& needed = surface.needed[surface.needs[i]];
          if (std::find(needed.begin(), needed.end(), left_out) != needed.end()) continue;
        }
        const SurfaceTriangle& t = surface.triangles[i];
        triangles.push_back({corner + t[0].cast<double>(), corner + t[1].cast<double>(), corner + t[2].cast<double>()});
      }
    }
  }
  return triangles;
}

std::vector<Triangle> WholeMesh(const MapSnapshot& map) {
  ThreadPool here(1);
  const Mesh mesh = ExtractMapMesh(map, MeshColoring::kInstance, here);
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    triangles.push_back({mesh.vertices_m[t[0]].cast<double>(), mesh.vertices_m[t[1]].cast<double>(),
                         mesh.vertices_m[t[2]].cast<double>()});
  }
  return triangles;
}

TEST(TileSurface, OfAllSubmapsTogetherIsTheMeshOfTheMapEachTriangleOnce) {
  constexpr SubmapId kNone(1000);
  std::size_t num_triangles = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    Map map = ShredsOfSeveral(seed, 2 + seed % 4);
    const auto state = map.Publish(0);
    const auto mesh = KeysOf(WholeMesh(*state));
    EXPECT_TRUE(KeysOf(SurfacesWithout(*state, kNone)) == mesh) << "seed " << seed;
    num_triangles += mesh.size();
  }
  EXPECT_GT(num_triangles, 1000u);
}

TEST(TileSurface, WhatIsLeftWithoutASubmapIsTheMeshOfAMapWithoutIt) {
  std::size_t num_left = 0, num_lost = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::uint32_t num_submaps = 2 + seed % 4;
    Map map = ShredsOfSeveral(seed, num_submaps);
    const auto state = map.Publish(0);
    const std::size_t num_all = WholeMesh(*state).size();
    for (std::uint32_t k = 1; k < num_submaps; ++k) {
      Map without = map.Fork();
      ASSERT_TRUE(without.Remove(SubmapId(k)));
      const auto mesh = KeysOf(WholeMesh(*without.Publish(0)));
      EXPECT_TRUE(KeysOf(SurfacesWithout(*state, SubmapId(k))) == mesh) << "seed " << seed << ", without " << k;
      num_left += mesh.size();
      num_lost += num_all - mesh.size();
    }
  }
  EXPECT_GT(num_left, 100u);
  EXPECT_GT(num_lost, 100u);
}

}  // namespace
}  // namespace dhpmap
