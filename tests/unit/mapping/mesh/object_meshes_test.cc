// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/object_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "mapping/mesh/map_mesh.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

using testing::kBallCenter_m;
using testing::kBallRadius_m;
using testing::kVoxel_m;

/// A triangle by where its corners are, beginning with the least: the same however its vertices are numbered.
using PlacedTriangle = std::array<std::array<float, 3>, 3>;

std::vector<PlacedTriangle> CornersOf(const Mesh& mesh) {
  std::vector<PlacedTriangle> all;
  for (const auto& triangle : mesh.triangles) {
    PlacedTriangle places;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f& p = mesh.vertices_m[triangle[k]];
      places[k] = {p.x(), p.y(), p.z()};
    }
    std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
    all.push_back(places);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// A ball whose voxels are three submaps': 1 left, 2 right, 3 below both.
class BallOfThree : public ::testing::Test {
 protected:
  static std::uint32_t OwnerAt(const Eigen::Vector3d& p) {
    if (p.z() < -0.11) return 3;
    return p.x() < 0.03 ? 1 : 2;
  }

  static Submap Part(std::uint32_t id) {
    Submap part = testing::SolidSubmap(testing::Sphere(kBallCenter_m, kBallRadius_m), {-2, -2, -2}, {1, 1, 1});
    part.mutable_info().id = SubmapId(id);
    part.mutable_info().class_id = ClassId(static_cast<std::uint16_t>(id));
    std::vector<BlockIndex> indices;
    for (const BlockEntry& entry : part.blocks().entries()) indices.push_back(entry.index);
    for (const BlockIndex index : indices) {
      TsdfBlock& tsdf = part.MutableTsdf(index);
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (OwnerAt(VoxelCentre(VoxelIn(index, i), kVoxel_m)) != id) tsdf.weight[static_cast<std::size_t>(i)] = 0;
      }
    }
    part.PruneBlocks();
    part.UpdateBoundingSphere();
    return part;
  }

  static MapSnapshot MapOf(std::vector<Submap> submaps) {
    MapInfo info;
    info.name = "map";
    info.config.voxel_size_m = kVoxel_m;
    std::vector<std::shared_ptr<const Submap>> shared;
    for (Submap& submap : submaps) shared.push_back(std::make_shared<const Submap>(std::move(submap)));
    return MapSnapshot(std::move(info), std::move(shared));
  }

  static MapSnapshot Ball() { return MapOf({Part(1), Part(2), Part(3)}); }

  static std::vector<const Submap*> AllOf(const MapSnapshot& map) {
    std::vector<const Submap*> all;
    for (const auto& submap : map.submaps()) all.push_back(submap.get());
    return all;
  }

  static Mesh OneOf(const MapSnapshot& map, std::uint32_t id) {
    const Submap* wanted = map.Find(SubmapId(id));
    return ExtractObjectMeshes(map, {&wanted, 1}, MeshColoring::kSensor).at(0).mesh;
  }
};

TEST_F(BallOfThree, TogetherHaveTheSurfaceOfTheMapWithNeitherGapsNorOverlaps) {
  const MapSnapshot map = Ball();
  ThreadPool pool(1);
  const std::vector<PlacedTriangle> whole = CornersOf(ExtractMapMesh(map, MeshColoring::kSensor, pool));
  std::vector<PlacedTriangle> together;
  for (const ObjectMesh& object : ExtractObjectMeshes(map, AllOf(map), MeshColoring::kSensor)) {
    const std::vector<PlacedTriangle> part = CornersOf(object.mesh);
    EXPECT_GT(part.size(), 100u) << object.id.value;
    together.insert(together.end(), part.begin(), part.end());
  }
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, whole);
}

TEST_F(BallOfThree, HaveTheSameSurfaceWhicheverOthersAreWanted) {
  const MapSnapshot map = Ball();
  for (const ObjectMesh& object : ExtractObjectMeshes(map, AllOf(map), MeshColoring::kSensor)) {
    EXPECT_EQ(CornersOf(OneOf(map, object.id.value)), CornersOf(object.mesh)) << object.id.value;
  }
}

TEST_F(BallOfThree, WhatWasMovedIsInItsOwnFrameToTheLastBit) {
  std::vector<std::vector<PlacedTriangle>> surfaces;
  for (const double angle_rad : {0.0, 0.3, std::numbers::pi / 2}) {
    Submap moved = Part(2);
    moved.mutable_info().is_placed = true;
    moved.mutable_info().T_map_submap =
        Eigen::Translation3d(angle_rad, 0.1, 0) * Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ());
    surfaces.push_back(CornersOf(OneOf(MapOf({Part(1), std::move(moved), Part(3)}), 2)));
  }
  EXPECT_FALSE(surfaces[0].empty());
  EXPECT_EQ(surfaces[1], surfaces[0]);
  EXPECT_EQ(surfaces[2], surfaces[0]);
}

TEST_F(BallOfThree, WhatIsAbsentIsMeshedByItselfAndCutsNothing) {
  Submap absent = Part(2);
  absent.mutable_info().presence = Presence::kAbsent;
  const MapSnapshot map = MapOf({Part(1), std::move(absent), Part(3)});
  EXPECT_EQ(CornersOf(OneOf(map, 2)),
            CornersOf(ExtractMesh(*map.Find(SubmapId(2)), LabelSet(), MeshColoring::kSensor)));
  EXPECT_EQ(CornersOf(OneOf(map, 1)), CornersOf(OneOf(MapOf({Part(1), Part(3)}), 1)));
}

TEST_F(BallOfThree, ArePlannedForByThoseNearAlone) {
  Submap far = testing::SolidSubmap(testing::Sphere({20, 0, 0}, 0.3), {48, -1, -1}, {51, 0, 0});
  far.mutable_info().id = SubmapId(4);
  far.UpdateBoundingSphere();
  const MapSnapshot map = MapOf({Part(1), Part(2), Part(3), std::move(far)});
  const Submap* wanted = map.Find(SubmapId(1));
  std::vector<std::uint32_t> ids;
  const MeshSources sources = MeshSourcesOf(map, {&wanted, 1});
  for (const Submap* submap : sources.around) ids.push_back(submap->id().value);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{1, 2, 3}));
  for (const SourceTile& source : sources.tiles) EXPECT_NE(source.submap->id().value, 4u);
}

TEST(MeshSources, AreOfALargeSubmapTheTilesNearTheSmallOneAlone) {
  Submap floor = testing::SolidSubmap([](const Eigen::Vector3d& p) { return p.z() - 0.02; }, {-40, -1, 0}, {40, 1, 0});
  floor.mutable_info().id = SubmapId(1);
  floor.UpdateBoundingSphere();
  Submap ball = testing::SolidSubmap(testing::Sphere({0.1, 0.1, 0.1}, 0.1), {0, 0, 0}, {0, 0, 0});
  ball.mutable_info().id = SubmapId(2);
  ball.UpdateBoundingSphere();
  MapInfo info;
  info.config.voxel_size_m = kVoxel_m;
  const MapSnapshot map(info, {std::make_shared<const Submap>(floor), std::make_shared<const Submap>(ball)});
  const Submap* wanted = map.Find(SubmapId(2));
  const MeshSources sources = MeshSourcesOf(map, {&wanted, 1});
  std::size_t num_tiles = 0, num_blocks = 0;
  for (const SourceTile& source : sources.tiles) {
    if (source.submap->id() != SubmapId(1)) continue;
    ++num_tiles;
    num_blocks += source.num_blocks;
  }
  EXPECT_EQ(num_blocks, 9u) << "around the ball's one block, in the plane";
  EXPECT_EQ(num_tiles, 4u) << "of the " << map.Find(SubmapId(1))->blocks().tiles().size();
}

TEST_F(BallOfThree, AreNotMadeForWhoHasGone) {
  std::stop_source gone;
  gone.request_stop();
  const MapSnapshot map = Ball();
  EXPECT_TRUE(ExtractObjectMeshes(map, AllOf(map), MeshColoring::kSensor, gone.get_token()).empty());
}

}  // namespace
}  // namespace dhpmap
