// SPDX-License-Identifier: BSD-3-Clause
// What sensors have looked through often enough is in no mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stop_token>
#include <utility>
#include <vector>

#include "mapping/mesh/map_mesh.h"
#include "mapping/mesh/mesh_stream.h"
#include "mapping/mesh/tile_surface.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

using Places = std::function<bool(const Eigen::Vector3d&)>;

const Places kRightHalf = [](const Eigen::Vector3d& p) { return p.x() > 0; };

Submap WholeBall(double radius_m = 0.55, std::uint32_t id = 7) {
  Submap ball = testing::SolidSubmap(testing::Sphere({0.013, -0.021, 0.007}, radius_m), {-2, -2, -2}, {1, 1, 1});
  ball.mutable_info().id = SubmapId(id);
  return ball;
}

std::vector<BlockIndex> IndicesOf(const Submap& submap) {
  std::vector<BlockIndex> indices;
  indices.reserve(submap.blocks().size());
  for (const BlockEntry& entry : submap.blocks().entries()) indices.push_back(entry.index);
  return indices;
}

/// With so often looked through where `places` says.
Submap LookedThrough(Submap submap, const Places& places, int count) {
  for (const BlockIndex index : IndicesOf(submap)) {
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (places(VoxelCentre(VoxelIn(index, linear), testing::kVoxel_m))) {
        submap.MutableGone(index).Set(linear, count);
      }
    }
  }
  return submap;
}

/// The same of which nobody has ever seen what is there.
Submap NeverSeen(const Submap& whole, const Places& places) {
  Submap rest(whole.info(), 1);
  for (const BlockEntry& entry : whole.blocks().entries()) {
    TsdfBlock& block = rest.MutableTsdf(entry.index);
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (places(VoxelCentre(VoxelIn(entry.index, linear), testing::kVoxel_m))) continue;
      const auto i = static_cast<std::size_t>(linear);
      block.distance_m[i] = entry.tsdf->distance_m[i];
      block.weight[i] = entry.tsdf->weight[i];
      block.color[i] = entry.tsdf->color[i];
    }
  }
  return rest;
}

std::shared_ptr<const MapSnapshot> StateHolding(std::vector<Submap> submaps) {
  MapInfo info;
  info.name = "map";
  info.config.voxel_size_m = testing::kVoxel_m;
  std::vector<std::shared_ptr<const Submap>> shared;
  shared.reserve(submaps.size());
  for (Submap& submap : submaps) shared.push_back(std::make_shared<const Submap>(std::move(submap)));
  return std::make_shared<const MapSnapshot>(std::move(info), std::move(shared));
}

std::shared_ptr<const MapSnapshot> StateHolding(Submap submap) {
  std::vector<Submap> one;
  one.push_back(std::move(submap));
  return StateHolding(std::move(one));
}

Mesh WholeMeshOf(const MapSnapshot& state) {
  ThreadPool here(1);
  return ExtractMapMesh(state, MeshColoring::kSensor, here);
}

/// All that a stream gives; `submap`: of this one alone.
Mesh StreamedMeshOf(std::shared_ptr<const MapSnapshot> state, const Submap* submap) {
  MeshStream stream(std::move(state), submap, MeshColoring::kSensor);
  Mesh all, piece;
  while (stream.NextVertices(piece)) {
    all.vertices_m.insert(all.vertices_m.end(), piece.vertices_m.begin(), piece.vertices_m.end());
    all.normals.insert(all.normals.end(), piece.normals.begin(), piece.normals.end());
    all.instances.insert(all.instances.end(), piece.instances.begin(), piece.instances.end());
  }
  while (stream.NextTriangles(piece)) {
    all.triangles.insert(all.triangles.end(), piece.triangles.begin(), piece.triangles.end());
  }
  EXPECT_EQ(all.vertices_m.size(), stream.num_vertices());
  return all;
}

void ExpectEqualMeshes(const Mesh& mesh, const Mesh& expected) {
  EXPECT_TRUE(mesh.vertices_m == expected.vertices_m);
  EXPECT_TRUE(mesh.normals == expected.normals);
  EXPECT_TRUE(mesh.instances == expected.instances);
  EXPECT_TRUE(mesh.triangles == expected.triangles);
}

/// In the mesh of the map, in that of the object alone, and in the streams of both.
void ExpectMeshedAs(const std::shared_ptr<const MapSnapshot>& state, const MapSnapshot& expected) {
  const Mesh whole = WholeMeshOf(expected);
  ExpectEqualMeshes(WholeMeshOf(*state), whole);
  ExpectEqualMeshes(StreamedMeshOf(state, nullptr), whole);
  for (const auto& submap : state->submaps()) {
    const Mesh alone = ExtractMesh(*expected.Find(submap->id()), LabelSet(), MeshColoring::kSensor);
    ExpectEqualMeshes(ExtractMesh(*submap, LabelSet(), MeshColoring::kSensor), alone);
    ExpectEqualMeshes(StreamedMeshOf(state, submap.get()), alone);
  }
}

TEST(GoneMesh, WhatIsContradictedIsMeshedAsIfNobodyHadSeenIt) {
  const auto state = StateHolding(LookedThrough(WholeBall(), kRightHalf, GoneBlock::kContradicted));
  const auto expected = StateHolding(NeverSeen(WholeBall(), kRightHalf));
  ExpectMeshedAs(state, *expected);
  const std::size_t num_whole = WholeMeshOf(*StateHolding(WholeBall())).triangles.size();
  const std::size_t num_left = WholeMeshOf(*state).triangles.size();
  EXPECT_GT(num_left, num_whole / 3);
  EXPECT_LT(num_left, num_whole / 2 + num_whole / 20);
}

TEST(GoneMesh, WhatIsOnlyDoubtedStays) {
  for (const int count : {1, 2}) {
    ExpectMeshedAs(StateHolding(LookedThrough(WholeBall(), kRightHalf, count)), *StateHolding(WholeBall()));
  }
}

TEST(GoneMesh, WhatIsLeftOfAnObjectMayBeNothing) {
  const auto everywhere = [](const Eigen::Vector3d&) { return true; };
  const auto state = StateHolding(LookedThrough(WholeBall(), everywhere, GoneBlock::kContradicted));
  EXPECT_TRUE(WholeMeshOf(*state).vertices_m.empty());
  EXPECT_TRUE(StreamedMeshOf(state, nullptr).vertices_m.empty());
  EXPECT_TRUE(StreamedMeshOf(state, state->Find(SubmapId(7))).vertices_m.empty());
}

TEST(GoneMesh, WhereAnotherObjectHasASurfaceItIsThatOneAlone) {
  std::vector<Submap> both, other_alone;
  both.push_back(LookedThrough(WholeBall(0.55, 7), kRightHalf, GoneBlock::kContradicted));
  both.push_back(WholeBall(0.5, 8));
  other_alone.push_back(NeverSeen(WholeBall(0.55, 7), kRightHalf));
  other_alone.push_back(WholeBall(0.5, 8));
  const auto state = StateHolding(std::move(both));
  ExpectMeshedAs(state, *StateHolding(std::move(other_alone)));
  const Mesh mesh = WholeMeshOf(*state);
  std::size_t num_right = 0;
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    if (mesh.vertices_m[i].x() < 2 * static_cast<float>(testing::kVoxel_m)) continue;  // labels reach over the border
    ++num_right;
    EXPECT_EQ(mesh.instances[i], 8u) << "not the average of what is there and what is gone";
    EXPECT_NEAR((mesh.vertices_m[i] - Eigen::Vector3f(0.013f, -0.021f, 0.007f)).norm(), 0.5f, 0.01f);
  }
  EXPECT_GT(num_right, 100u);
}

TEST(GoneMesh, AnAbsentObjectIsOutOfTheMapsMeshButHasOneOfItsOwn) {
  Submap absent = WholeBall(0.55, 7);
  absent.mutable_info().presence = Presence::kAbsent;
  std::vector<Submap> both;
  both.push_back(std::move(absent));
  both.push_back(WholeBall(0.3, 8));
  const auto state = StateHolding(std::move(both));
  const Mesh there = WholeMeshOf(*StateHolding(WholeBall(0.3, 8)));
  ASSERT_FALSE(there.vertices_m.empty());
  ExpectEqualMeshes(WholeMeshOf(*state), there);
  ExpectEqualMeshes(StreamedMeshOf(state, nullptr), there);
  EXPECT_FALSE(StreamedMeshOf(state, state->Find(SubmapId(7))).vertices_m.empty());
}

/// How far to the right a submap's surface reaches, as queries see it.
double RightmostOf(const Submap& submap) {
  double rightmost_m = -std::numeric_limits<double>::infinity();
  for (const TileEntry& tile : submap.blocks().tiles()) {
    const Eigen::Vector3d corner_m = TileCorner(tile.index, testing::kVoxel_m);
    const auto around = FindBlocks(FindNeighbourhood(submap.blocks(), tile.index), tile.index);
    for (const SurfaceTriangle& triangle : ExtractTileSurface(around, testing::kVoxel_m)) {
      for (const Eigen::Vector3f& p : triangle)
        rightmost_m = std::max(rightmost_m, corner_m.x() + p.cast<double>().x());
    }
  }
  return rightmost_m;
}

TEST(GoneMesh, NoSurfaceReachesIntoWhatWasLookedThroughNorIntoTheUnseen) {
  constexpr double kHalf_m = 0.5 * testing::kVoxel_m;
  EXPECT_GT(RightmostOf(WholeBall()), 0.5);
  EXPECT_NEAR(RightmostOf(NeverSeen(WholeBall(), kRightHalf)), -kHalf_m, 1e-5) << "to the last voxel's centre";
  EXPECT_NEAR(RightmostOf(LookedThrough(WholeBall(), kRightHalf, GoneBlock::kContradicted)), -kHalf_m, 1e-5);
  EXPECT_GT(RightmostOf(LookedThrough(WholeBall(), kRightHalf, 2)), 0.5);
}

}  // namespace
}  // namespace dhpmap
