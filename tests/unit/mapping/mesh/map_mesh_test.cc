// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/map_mesh.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "mapping/mesh/mesh_stream.h"
#include "tests/unit/mapping/mesh/mesh_checks.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

using testing::Area_m2;
using testing::kBallCenter_m;
using testing::kBallRadius_m;
using testing::kVoxel_m;
using testing::SolidSubmap;
using testing::Sphere;

/// Which of several submaps owns a voxel centre.
using OwnerFunction = std::function<std::uint32_t(const Eigen::Vector3d&)>;

/// `number` is the id, and the class unless that is 0: the unknown submap.
Submap Numbered(Submap submap, std::uint32_t number) {
  SubmapInfo& info = submap.mutable_info();
  info.id = SubmapId(number);
  info.class_id = ClassId(static_cast<std::uint16_t>(number));
  info.panoptic = number == 0 ? Panoptic::kUnknown : Panoptic::kThing;
  return submap;
}

/// What label management would leave of `whole` in submap `number`.
Submap OwnedPart(const Submap& whole, std::uint32_t number, const OwnerFunction& owner) {
  Submap part = Numbered(whole, number);
  part.ShareBlocks();
  for (const BlockEntry& entry : whole.blocks().entries()) {
    TsdfBlock& tsdf = part.MutableTsdf(entry.index);
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (owner(VoxelCentre(VoxelIn(entry.index, i), kVoxel_m)) != number) tsdf.weight[static_cast<std::size_t>(i)] = 0;
    }
  }
  part.PruneBlocks();
  return part;
}

MapSnapshot MapOf(std::vector<Submap> submaps) {
  MapInfo info;
  info.name = "map";
  info.config.voxel_size_m = kVoxel_m;
  std::vector<std::shared_ptr<const Submap>> shared;
  for (Submap& submap : submaps) shared.push_back(std::make_shared<const Submap>(std::move(submap)));
  return MapSnapshot(std::move(info), std::move(shared));
}

Mesh Extract(const MapSnapshot& map, int num_threads = 1, MeshColoring coloring = MeshColoring::kSensor) {
  ThreadPool pool(num_threads);
  return ExtractMapMesh(map, coloring, pool);
}

std::size_t SumOfTriangles(const MapSnapshot& map) {
  std::size_t sum = 0;
  for (const auto& submap : map.submaps()) {
    sum += ExtractMesh(*submap, LabelSet(), MeshColoring::kSensor).triangles.size();
  }
  return sum;
}

void ExpectSame(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.vertices_m, b.vertices_m);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.classes, b.classes);
  EXPECT_EQ(a.instances, b.instances);
  EXPECT_EQ(a.triangles, b.triangles);
}

Submap SphereSubmap() { return SolidSubmap(Sphere(kBallCenter_m, kBallRadius_m), {-2, -2, -2}, {1, 1, 1}); }

/// Three sectors around the vertical; borders run obliquely through blocks and cells.
std::uint32_t SectorOf(const Eigen::Vector3d& p) {
  const double turns = std::atan2(p.y(), p.x()) / (2 * std::numbers::pi) + 0.5;
  return 1 + std::min(2u, static_cast<std::uint32_t>(3 * turns));
}

MapSnapshot SphereOfThree() {
  const Submap whole = SphereSubmap();
  return MapOf({OwnedPart(whole, 1, SectorOf), OwnedPart(whole, 2, SectorOf), OwnedPart(whole, 3, SectorOf)});
}

TEST(ExtractMapMesh, PlaneSplitBetweenTwoSubmapsIsThePlaneOfOne) {
  const Submap whole =
      SolidSubmap([](const Eigen::Vector3d& p) { return p.z() + 0.3 * kVoxel_m; }, {-1, -1, -1}, {1, 1, 0});
  const OwnerFunction owner = [](const Eigen::Vector3d& p) { return p.x() + 0.6 * p.y() < 0.07 ? 1u : 2u; };
  const MapSnapshot map = MapOf({OwnedPart(whole, 1, owner), OwnedPart(whole, 2, owner)});
  const Mesh mesh = Extract(map), expected = ExtractMesh(whole, LabelSet(), MeshColoring::kSensor);
  EXPECT_EQ(mesh.vertices_m, expected.vertices_m);
  EXPECT_EQ(mesh.normals, expected.normals);
  EXPECT_EQ(mesh.triangles, expected.triangles);
  EXPECT_NEAR(Area_m2(mesh), std::pow(23 * kVoxel_m, 2), 1e-4);
  EXPECT_LT(SumOfTriangles(map), mesh.triangles.size()) << "submap by submap leaves no gaps: tests nothing";
}

TEST(ExtractMapMesh, SphereOfThreeOwnersIsWatertight) {
  const MapSnapshot map = SphereOfThree();
  const Mesh mesh = Extract(map);
  testing::ExpectPlanesMatch(mesh);
  EXPECT_EQ(testing::EulerCharacteristic(mesh), 2);
  EXPECT_NEAR(Area_m2(mesh), 4 * std::numbers::pi * kBallRadius_m * kBallRadius_m, 0.01 * Area_m2(mesh));
  EXPECT_EQ(std::set<std::uint32_t>(mesh.instances.begin(), mesh.instances.end()), (std::set<std::uint32_t>{1, 2, 3}));
  EXPECT_LT(SumOfTriangles(map), mesh.triangles.size());
}

TEST(ExtractMapMesh, VertexBetweenAsManyCornersOfTwoHasTheLabelOfTheNearerEndOfItsEdge) {
  // The lower layer is submap 1's, the upper one 2's.
  const OwnerFunction owner = [](const Eigen::Vector3d& p) { return p.z() < 0 ? 1u : 2u; };
  for (const double height_vox : {-0.3, 0.3}) {
    const Submap whole =
        SolidSubmap([=](const Eigen::Vector3d& p) { return p.z() - height_vox * kVoxel_m; }, {0, 0, -1}, {0, 0, 0});
    Submap lower = OwnedPart(whole, 1, owner);
    lower.MutableLabels({0, 0, -1}).AddObservation(LinearIndex({3, 4, 7}), ClassId(30));
    const Mesh mesh = Extract(MapOf({std::move(lower), OwnedPart(whole, 2, owner)}));
    ASSERT_EQ(mesh.triangles.size(), 2u * 7 * 7);
    for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
      EXPECT_EQ(mesh.instances[i], height_vox < 0 ? 1u : 2u);
      EXPECT_EQ(mesh.classes[i], mesh.instances[i]);
    }
  }
}

TEST(ExtractMapMesh, VertexHasTheLabelOfMostCornersAroundItsEdge) {
  const Submap whole =
      SolidSubmap([](const Eigen::Vector3d& p) { return p.z() + 0.3 * kVoxel_m; }, {0, 0, -1}, {1, 0, 0});
  // Submap 2 has all beyond x = 8 voxels, a block border, and a single voxel on the near side, just below the surface.
  const OwnerFunction owner = [](const Eigen::Vector3d& p) {
    const VoxelIndex v = VoxelAt(p, kVoxel_m);
    return v.x >= 8 || v == VoxelIndex{3, 4, -1} ? 2u : 1u;
  };
  const Mesh mesh = Extract(MapOf({OwnedPart(whole, 1, owner), OwnedPart(whole, 2, owner)}));
  ASSERT_EQ(mesh.triangles.size(), 2u * 15 * 7);
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    EXPECT_EQ(mesh.instances[i], mesh.vertices_m[i].x() < 8 * kVoxel_m ? 1u : 2u) << mesh.vertices_m[i].transpose();
    EXPECT_EQ(mesh.classes[i], mesh.instances[i]);
  }
}

TEST(ExtractMapMesh, UnknownSubmapFillsGapsAndLeavesLabelsToItsNeighbours) {
  const Submap whole =
      SolidSubmap([](const Eigen::Vector3d& p) { return p.z() + 0.3 * kVoxel_m; }, {0, 0, -1}, {0, 0, 0});
  // Of the columns from the fifth on nobody knows anything, of the others, submap 5 has only the upper half. The fifth
  // has neighbours that are known.
  const OwnerFunction owner = [](const Eigen::Vector3d& p) { return p.z() > 0 && p.x() < 4 * kVoxel_m ? 5u : 0u; };
  const MapSnapshot map = MapOf({OwnedPart(whole, 0, owner), OwnedPart(whole, 5, owner)});
  const Mesh mesh = Extract(map, 1, MeshColoring::kInstance);
  ASSERT_EQ(mesh.triangles.size(), 2u * 7 * 7);
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    const std::uint32_t expected = mesh.vertices_m[i].x() < 5 * kVoxel_m ? 5 : 0;
    EXPECT_EQ(mesh.instances[i], expected);
    EXPECT_EQ(mesh.classes[i], expected);
    EXPECT_EQ(mesh.colors[i], ColorOfId(expected));
  }
}

TEST(ExtractMapMesh, OverlappingSubmapsAreAveragedAndTheBestSupportedAnswers) {
  const auto plane = [](std::uint32_t number, double height_vox, float weight, Color color, int num_observations) {
    Submap submap = Numbered(
        SolidSubmap([=](const Eigen::Vector3d& p) { return p.z() - height_vox * kVoxel_m; }, {0, 0, -1}, {0, 0, 0}),
        number);
    for (const int z : {-1, 0}) {
      submap.MutableTsdf({0, 0, z}).weight.fill(weight);
      submap.MutableTsdf({0, 0, z}).color.fill(color);
      for (int i = 0; i < num_observations * kBlockVoxels; ++i) {
        submap.MutableLabels({0, 0, z}).AddObservation(i % kBlockVoxels, ClassId(static_cast<std::uint16_t>(number)));
      }
    }
    return submap;
  };
  const Mesh mesh = Extract(MapOf({plane(1, 0.4, 1.0f, {200, 0, 0}, 2), plane(2, 0.0, 3.0f, {0, 100, 0}, 5)}));
  ASSERT_EQ(mesh.triangles.size(), 2u * 7 * 7) << "one surface, not two";
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    EXPECT_NEAR(mesh.vertices_m[i].z(), 0.1 * kVoxel_m, 1e-6);  // (0.4 + 3 * 0) / 4
    EXPECT_EQ(mesh.colors[i], (Color{50, 75, 0}));
    EXPECT_EQ(mesh.instances[i], 2u);
    EXPECT_EQ(mesh.classes[i], 2);
  }
}

TEST(ExtractMapMesh, SubmapsOffTheGridAreAppendedWhereTheyAre) {
  Submap moved = Numbered(SphereSubmap(), 8), coarse = Numbered(SphereSubmap(), 9);
  moved.mutable_info().T_map_submap.translation() = Eigen::Vector3d(3, 0.01, 0);
  coarse.mutable_info().voxel_size_m = 2 * kVoxel_m;
  const MapSnapshot map = MapOf({Numbered(SphereSubmap(), 1), moved, coarse});
  Mesh expected = Extract(MapOf({Numbered(SphereSubmap(), 1)}));
  AppendMesh(ExtractMesh(moved, LabelSet(), MeshColoring::kSensor), expected);
  AppendMesh(ExtractMesh(coarse, LabelSet(), MeshColoring::kSensor), expected);
  const Mesh mesh = Extract(map);
  ExpectSame(mesh, expected);
  const auto first_moved = std::find(mesh.instances.begin(), mesh.instances.end(), 8u) - mesh.instances.begin();
  EXPECT_GT(mesh.vertices_m[static_cast<std::size_t>(first_moved)].x(), 2.0f);
}

TEST(ExtractMapMesh, DoesNotDependOnTheNumberOfThreads) {
  std::vector<Submap> submaps;  // overlapping spheres: thousands of shared blocks and edges
  for (std::uint32_t number = 1; number <= 4; ++number) {
    const Eigen::Vector3d center_m(0.3 * number, 0.2 * number, -0.1 * number);
    submaps.push_back(Numbered(SolidSubmap(Sphere(center_m, 1.3), {-4, -4, -4}, {5, 4, 3}, number), number));
  }
  const MapSnapshot map = MapOf(std::move(submaps));
  const Mesh one = Extract(map, 1);
  ASSERT_GT(one.triangles.size(), 10'000u);
  for (const int num_threads : {2, 3, 8}) ExpectSame(Extract(map, num_threads), one);
}

TEST(ExtractMapMesh, MapOfOneSubmapIsThatSubmapsMesh) {
  const Submap submap = Numbered(SphereSubmap(), 4);
  ExpectSame(Extract(MapOf({submap})), ExtractMesh(submap, LabelSet(), MeshColoring::kSensor));
}

TEST(ExtractMapMesh, EmptyMapGivesNothing) {
  EXPECT_TRUE(Extract(MapOf({})).vertices_m.empty());
  EXPECT_TRUE(Extract(MapOf({Numbered(Submap(testing::SolidInfo(), 1), 0)})).triangles.empty());
}

/// A map with overlapping submaps on the grid, one moved off it and one with larger voxels.
MapSnapshot MixedMap() {
  std::vector<Submap> submaps;
  for (std::uint32_t number = 1; number <= 3; ++number) {
    const Eigen::Vector3d center_m(0.3 * number, 0.2 * number, -0.1 * number);
    submaps.push_back(Numbered(SolidSubmap(Sphere(center_m, 1.3), {-4, -4, -4}, {5, 4, 3}, number), number));
  }
  submaps.push_back(Numbered(SphereSubmap(), 8));
  submaps.back().mutable_info().T_map_submap.translation() = Eigen::Vector3d(3, 0.01, 0);
  submaps.push_back(Numbered(SphereSubmap(), 9));
  submaps.back().mutable_info().voxel_size_m = 2 * kVoxel_m;
  return MapOf(std::move(submaps));
}

/// All pieces of a stream put together.
Mesh Joined(MeshStream stream) {
  Mesh whole, piece;
  while (stream.NextVertices(piece)) {
    EXPECT_TRUE(piece.triangles.empty());
    EXPECT_LE(piece.vertices_m.size(), 4096u + 3 * kBlockVoxels) << "pieces are small";
    AppendMesh(piece, whole);
  }
  while (stream.NextTriangles(piece)) {
    EXPECT_TRUE(piece.vertices_m.empty());
    EXPECT_LE(piece.triangles.size(), 8192u + 5 * kBlockVoxels);
    whole.triangles.insert(whole.triangles.end(), piece.triangles.begin(), piece.triangles.end());
  }
  return whole;
}

TEST(MeshStream, PiecesOfAMapAreItsMesh) {
  const auto map = std::make_shared<const MapSnapshot>(MixedMap());
  const Mesh expected = Extract(*map, 2, MeshColoring::kInstance);
  ASSERT_GT(expected.triangles.size(), 20'000u) << "several pieces";
  MeshStream stream(map, nullptr, MeshColoring::kInstance);
  EXPECT_EQ(stream.num_vertices(), expected.vertices_m.size());
  EXPECT_EQ(stream.num_triangles(), expected.triangles.size());
  ExpectSame(Joined(std::move(stream)), expected);
}

TEST(MeshStream, PiecesOfASubmapAreItsMesh) {
  const auto map = std::make_shared<const MapSnapshot>(MixedMap());
  for (const auto& submap : map->submaps()) {
    ExpectSame(Joined(MeshStream(map, submap.get(), MeshColoring::kClass)),
               ExtractMesh(*submap, LabelSet(), MeshColoring::kClass));
  }
}

TEST(MeshStream, KeepsItsStateAlive) {
  auto map = std::make_shared<const MapSnapshot>(MixedMap());
  const Mesh expected = Extract(*map);
  MeshStream stream(map, nullptr, MeshColoring::kSensor);
  map.reset();
  ExpectSame(Joined(std::move(stream)), expected);
}

TEST(MeshStream, NothingGivesNothing) {
  MeshStream stream(std::make_shared<const MapSnapshot>(MapOf({})), nullptr, MeshColoring::kSensor);
  EXPECT_EQ(stream.num_vertices() + stream.num_triangles(), 0u);
  Mesh piece;
  EXPECT_FALSE(stream.NextVertices(piece));
  EXPECT_FALSE(stream.NextTriangles(piece));
}

TEST(MeshStream, IsEmptyOnceNobodyWantsIt) {
  std::stop_source stop;
  stop.request_stop();
  MeshStream stream(std::make_shared<const MapSnapshot>(MixedMap()), nullptr, MeshColoring::kSensor, stop.get_token());
  Mesh piece;
  EXPECT_EQ(stream.num_vertices(), 0u);
  EXPECT_FALSE(stream.NextVertices(piece));
}

}  // namespace
}  // namespace dhpmap
