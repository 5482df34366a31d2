// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>

#include "mapping/mesh/mesh.h"
#include "tests/unit/mapping/mesh/mesh_checks.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

using testing::DistanceFunction;
using testing::EulerCharacteristic;
using testing::ExpectPlanesMatch;
using testing::ExpectWatertight;
using testing::FaceNormal;
using testing::kBallCenter_m;
using testing::kBallRadius_m;
using testing::kVoxel_m;
using testing::SolidSubmap;
using testing::Sphere;

constexpr double kVertexTolerance_m = 0.1 * kVoxel_m;  // linear interpolation of a curved field

Mesh Extract(const Submap& submap) { return ExtractMesh(submap, LabelSet(), MeshColoring::kSensor); }

Mesh SphereMesh(unsigned seed = 0) {
  return Extract(SolidSubmap(Sphere(kBallCenter_m, kBallRadius_m), {-2, -2, -2}, {1, 1, 1}, seed));
}

TEST(ExtractMesh, VerticesLieOnTheSphere) {
  const Mesh mesh = SphereMesh();
  ASSERT_GT(mesh.vertices_m.size(), 1000u);
  ExpectPlanesMatch(mesh);
  for (const Eigen::Vector3f& v : mesh.vertices_m) {
    EXPECT_NEAR((v.cast<double>() - kBallCenter_m).norm(), kBallRadius_m, kVertexTolerance_m);
  }
}

TEST(ExtractMesh, SphereIsWatertightAcrossBlockBordersAndHasEulerCharacteristicTwo) {
  EXPECT_EQ(EulerCharacteristic(SphereMesh()), 2);
}

TEST(ExtractMesh, TrianglesAndNormalsFaceOutwards) {
  const Mesh mesh = SphereMesh();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f middle = (mesh.vertices_m[t[0]] + mesh.vertices_m[t[1]] + mesh.vertices_m[t[2]]) / 3;
    EXPECT_GE(FaceNormal(mesh, t).dot(middle - kBallCenter_m.cast<float>()), 0.0f);
  }
  constexpr double kCosine = 0.998;  // 3.6 degrees: differences over one voxel, a field clipped at 3 voxels
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    EXPECT_NEAR(mesh.normals[i].norm(), 1.0f, 1e-5f);
    const Eigen::Vector3d outwards = (mesh.vertices_m[i].cast<double>() - kBallCenter_m).normalized();
    EXPECT_GT(mesh.normals[i].cast<double>().dot(outwards), kCosine);
  }
}

TEST(ExtractMesh, TorusHasEulerCharacteristicZero) {
  const DistanceFunction torus = [](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(p.head<2>().norm() - 0.5, p.z() - 0.01).norm() - 0.2;
  };
  EXPECT_EQ(EulerCharacteristic(Extract(SolidSubmap(torus, {-2, -2, -1}, {1, 1, 0}))), 0);
}

TEST(ExtractMesh, NoiseIsStillAClosedSurface) {
  // Random signs bring up every one of the 256 cases, the ambiguous ones above all.
  std::mt19937 random(3);
  std::map<std::array<int, 3>, double> values;
  const DistanceFunction noise = [&](const Eigen::Vector3d& p) {
    const VoxelIndex v = VoxelAt(p, kVoxel_m);
    for (const int i : {v.x, v.y, v.z}) {
      if (i == -8 || i == 7) return 0.1;  // the rim is outside, so that the surface closes
    }
    const auto [it, is_new] = values.try_emplace({v.x, v.y, v.z});
    if (is_new) it->second = std::uniform_real_distribution(-0.1, 0.1)(random);
    return it->second;
  };
  const Mesh mesh = Extract(SolidSubmap(noise, {-1, -1, -1}, {0, 0, 0}));
  ASSERT_GT(mesh.triangles.size(), 5000u);
  ExpectPlanesMatch(mesh);
  ExpectWatertight(mesh);
}

TEST(ExtractMesh, SurfaceThroughVoxelCentresHasNoCollapsedTriangles) {
  const DistanceFunction plane = [](const Eigen::Vector3d& p) { return p.z() - 0.5 * kVoxel_m; };
  const Mesh mesh = Extract(SolidSubmap(plane, {-1, -1, -1}, {0, 0, 0}));
  ASSERT_EQ(mesh.triangles.size(), 2u * 15 * 15);
  for (const auto& t : mesh.triangles) EXPECT_GT(FaceNormal(mesh, t).z(), 0.9f * kVoxel_m * kVoxel_m);
  for (const Eigen::Vector3f& n : mesh.normals) EXPECT_GT(n.z(), 0.999f);
}

TEST(ExtractMesh, DoesNotDependOnTheOrderOfAllocation) {
  const Mesh a = SphereMesh(1), b = SphereMesh(2);
  EXPECT_EQ(a.vertices_m, b.vertices_m);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(ExtractMesh, LeavesOutCellsWithAnUnobservedCorner) {
  Submap submap = SolidSubmap([](const Eigen::Vector3d& p) { return p.z(); }, {0, 0, -1}, {0, 0, 0});
  ASSERT_EQ(Extract(submap).triangles.size(), 2u * 7 * 7);
  submap.MutableTsdf({0, 0, 0}).weight[LinearIndex({3, 4, 0})] = 0.0f;
  const Mesh mesh = Extract(submap);
  EXPECT_EQ(mesh.triangles.size(), 2u * (7 * 7 - 4));
  ExpectPlanesMatch(mesh);
  submap.MutableTsdf({0, 0, 0}).weight.fill(0.0f);
  EXPECT_TRUE(Extract(submap).triangles.empty());
}

TEST(ExtractMesh, EmptySubmapAndBlocksWithoutGeometryGiveNothing) {
  Submap submap(testing::SolidInfo(), 1);
  EXPECT_TRUE(Extract(submap).vertices_m.empty());
  submap.MutableLabels({1, 2, 3});
  EXPECT_TRUE(Extract(submap).vertices_m.empty());
}

TEST(ExtractMesh, MovesWithItsSubmap) {
  Submap submap = SolidSubmap(Sphere(kBallCenter_m, 0.3), {-1, -1, -1}, {0, 0, 0});
  const Mesh before = Extract(submap);
  Transform T = Transform::Identity();
  T.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(10, -20, 5);
  submap.mutable_info().T_map_submap = T;
  const Mesh after = Extract(submap);
  ASSERT_EQ(after.vertices_m.size(), before.vertices_m.size());
  EXPECT_EQ(after.triangles, before.triangles);
  for (std::size_t i = 0; i < before.vertices_m.size(); ++i) {
    const Eigen::Vector3d moved = T * before.vertices_m[i].cast<double>();
    EXPECT_LT((after.vertices_m[i].cast<double>() - moved).norm(), 1e-5);
    EXPECT_LT((after.normals[i].cast<double>() - T.linear() * before.normals[i].cast<double>()).norm(), 1e-5);
  }
}

/// A plane just above voxel (x, y, -1); vertices lie between z = -1 (nearer) and z = 0.
Submap PlaneSubmap() {
  const double height_m = -0.3 * kVoxel_m;
  return SolidSubmap([=](const Eigen::Vector3d& p) { return p.z() - height_m; }, {0, 0, -1}, {0, 0, 0});
}

TEST(ExtractMesh, InterpolatesSensorColour) {
  Submap submap = PlaneSubmap();
  submap.MutableTsdf({0, 0, -1}).color.fill({100, 0, 0});
  submap.MutableTsdf({0, 0, 0}).color.fill({0, 200, 0});
  for (const Color c : Extract(submap).colors) EXPECT_EQ(c, (Color{80, 40, 0}));  // 0.2 of the way up
}

TEST(ExtractMesh, TakesTheClassOfTheSubmap) {
  Submap submap = PlaneSubmap();
  LabelBlock& below = submap.MutableLabels({0, 0, -1});
  LabelBlock& above = submap.MutableLabels({0, 0, 0});
  for (int linear = 0; linear < kBlockVoxels; ++linear) above.AddObservation(linear, ClassId(9));
  for (int y = 0; y < kBlockSide; ++y) below.AddObservation(LinearIndex({0, y, 7}), ClassId(5));
  const Mesh mesh = Extract(submap);
  for (std::size_t i = 0; i < mesh.classes.size(); ++i) {
    EXPECT_EQ(mesh.classes[i], 2);
    EXPECT_EQ(mesh.instances[i], 7u);
  }
}

TEST(ExtractMesh, ColoursByClassAndByInstance) {
  const LabelSet labels =
      LabelSet::Create({{ClassId(2), "chair", Panoptic::kThing, SizeClass::kMedium, {1, 2, 3}}}).value();
  Submap submap = PlaneSubmap();
  EXPECT_EQ(ExtractMesh(submap, labels, MeshColoring::kClass).colors[0], (Color{1, 2, 3}));
  EXPECT_EQ(ExtractMesh(submap, LabelSet(), MeshColoring::kClass).colors[0], ColorOfId(2));
  EXPECT_EQ(ExtractMesh(submap, labels, MeshColoring::kInstance).colors[0], ColorOfId(7));
  submap.mutable_info().panoptic = Panoptic::kUnknown;
  EXPECT_EQ(ExtractMesh(submap, labels, MeshColoring::kInstance).colors[0], ColorOfId(0));
}

TEST(AppendMesh, KeepsEveryTriangleOnItsVertices) {
  const Mesh part = Extract(PlaneSubmap());
  Mesh whole = SphereMesh();
  const std::size_t vertices = whole.vertices_m.size(), triangles = whole.triangles.size();
  AppendMesh(part, whole);
  ExpectPlanesMatch(whole);
  ASSERT_EQ(whole.triangles.size(), triangles + part.triangles.size());
  EXPECT_EQ(whole.triangles.back()[2], part.triangles.back()[2] + vertices);
  EXPECT_EQ(whole.vertices_m[vertices], part.vertices_m[0]);
}

TEST(ColorOfId, TellsTheFirstThousandApart) {
  std::map<std::array<int, 3>, int> seen;
  for (std::uint32_t id = 0; id < 1000; ++id) {
    const Color c = ColorOfId(id);
    ++seen[{c.r / 2, c.g / 2, c.b / 2}];
    if (id > 1) {
      const Color last = ColorOfId(id - 1);
      EXPECT_GT(std::abs(c.r - last.r) + std::abs(c.g - last.g) + std::abs(c.b - last.b), 60) << id;
    }
  }
  EXPECT_GT(seen.size(), 950u);
}

TEST(ExtractMesh, MeshesASheetAcrossThousandsOfBlocks) {
  // A wavy sheet: 70 x 70 blocks of surface, 2 high.
  const DistanceFunction sheet = [](const Eigen::Vector3d& p) {
    return p.z() - 0.2 * std::sin(p.x()) * std::sin(p.y() * 1.3);
  };
  const Submap submap = SolidSubmap(sheet, {0, 0, -1}, {49, 49, 0});
  ASSERT_EQ(submap.blocks().size(), 5000u);
  EXPECT_GT(Extract(submap).triangles.size(), 300'000u);
}

}  // namespace
}  // namespace dhpmap
