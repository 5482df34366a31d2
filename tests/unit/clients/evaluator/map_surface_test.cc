// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/map_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

constexpr double kVoxel_m = 0.04;

Map EmptyMap() {
  MapInfo info;
  info.config.voxel_size_m = kVoxel_m;
  info.label_set = dhpmap::testing::MakeLabelSet(2, 1);
  return Map(info);
}

SubmapId AddThing(Map& map, std::uint16_t class_id) {
  SubmapInfo info;
  info.panoptic = Panoptic::kThing;
  info.class_id = ClassId(class_id);
  info.voxel_size_m = kVoxel_m;
  return map.Create(info).id();
}

/// Observes the plane z = 0.1 m for voxels with x in [begin, end), y in [0, 16).
void AddPlane(Map& map, SubmapId id, int begin, int end, std::uint32_t observations = 1) {
  Submap& submap = *map.FindMutable(id);
  for (int x = begin; x < end; ++x) {
    for (int y = 0; y < 16; ++y) {
      for (int z = 0; z < 6; ++z) {
        const VoxelIndex v{x, y, z};
        TsdfBlock& tsdf = submap.MutableTsdf(BlockOf(v));
        tsdf.distance_m[LinearIndex(v)] = static_cast<float>((z + 0.5) * kVoxel_m - 0.1);
        tsdf.weight[LinearIndex(v)] = 1;
        if (id == kUnknownSubmap) continue;
        submap.MutableLabels(BlockOf(v))
            .Add(LinearIndex(v), {{{submap.info().class_id.value, observations}}, {{kOwnInstance, observations}}});
      }
    }
  }
}

double Area_m2(const Mesh& mesh) {
  double area_m2 = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices_m[a].cast<double>();
    area_m2 += 0.5 * (mesh.vertices_m[b].cast<double>() - p).cross(mesh.vertices_m[c].cast<double>() - p).norm();
  }
  return area_m2;
}

TEST(MapSurface, AsOneFieldHasNoGapBetweenSubmaps) {
  Map map = EmptyMap();
  AddPlane(map, AddThing(map, 1), 0, 12);
  AddPlane(map, AddThing(map, 2), 12, 24);
  const double strip_m2 = 15 * kVoxel_m * kVoxel_m;  // one column of cells
  EXPECT_NEAR(Area_m2(SurfaceOf(map, SurfaceKind::kEachSubmap).mesh), 22 * strip_m2, 1e-6);
  EXPECT_NEAR(Area_m2(SurfaceOf(map, SurfaceKind::kOneField).mesh), 23 * strip_m2, 1e-6);
}

TEST(MapSurface, HasTheLabelOfTheSubmapAtEachPlace) {
  Map map = EmptyMap();
  const SubmapId left = AddThing(map, 1), right = AddThing(map, 2);
  AddPlane(map, left, 0, 12);
  AddPlane(map, right, 12, 24);
  const Mesh mesh = SurfaceOf(map, SurfaceKind::kOneField).mesh;
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    EXPECT_EQ(mesh.classes[i], mesh.instances[i] == left.value ? 1 : 2);
    const float x_m = mesh.vertices_m[i].x();
    if (std::abs(x_m - 12 * kVoxel_m) < kVoxel_m) continue;
    EXPECT_EQ(mesh.instances[i], x_m < 12 * kVoxel_m ? left.value : right.value);
  }
}

TEST(MapSurface, ASingleStrayVoxelDoesNotShow) {
  Map map = EmptyMap();
  const SubmapId plane = AddThing(map, 1), stray = AddThing(map, 2);
  AddPlane(map, plane, 0, 16);
  const VoxelIndex v{8, 8, 2};
  map.FindMutable(plane)->MutableLabels(BlockOf(v)).Clear(LinearIndex(v));
  map.FindMutable(plane)->MutableTsdf(BlockOf(v)).weight[LinearIndex(v)] = 0;
  TsdfBlock& tsdf = map.FindMutable(stray)->MutableTsdf(BlockOf(v));
  tsdf.distance_m[LinearIndex(v)] = static_cast<float>(2.5 * kVoxel_m - 0.1);
  tsdf.weight[LinearIndex(v)] = 1;
  map.FindMutable(stray)->MutableLabels(BlockOf(v)).Add(LinearIndex(v), {{{2, 1}}, {{kOwnInstance, 1}}});
  const Mesh mesh = SurfaceOf(map, SurfaceKind::kOneField).mesh;
  EXPECT_NEAR(Area_m2(mesh), 225 * kVoxel_m * kVoxel_m, 1e-6) << "and leaves no hole";
  EXPECT_EQ(std::set<std::uint32_t>(mesh.instances.begin(), mesh.instances.end()), std::set{plane.value});
}

TEST(MapSurface, TakesTheObjectSeenMostWhereSubmapsOverlap) {
  Map map = EmptyMap();
  const SubmapId often = AddThing(map, 1), seldom = AddThing(map, 2);
  AddPlane(map, often, 0, 16, 5);
  AddPlane(map, seldom, 0, 16, 2);
  const Mesh one = SurfaceOf(map, SurfaceKind::kOneField).mesh;
  EXPECT_EQ(std::set<std::uint32_t>(one.instances.begin(), one.instances.end()), std::set{often.value});
  const Mesh each = SurfaceOf(map, SurfaceKind::kEachSubmap).mesh;
  EXPECT_NEAR(Area_m2(each), 2 * Area_m2(one), 1e-6);
}

TEST(MapSurface, OfTheUnknownSubmapSaysNothing) {
  Map map = EmptyMap();
  map.FindMutable(kUnknownSubmap)->mutable_info().voxel_size_m = kVoxel_m;
  AddPlane(map, kUnknownSubmap, 0, 16);
  for (const SurfaceKind kind : {SurfaceKind::kEachSubmap, SurfaceKind::kOneField}) {
    const LabelledSurface surface = SurfaceOf(map, kind);
    ASSERT_FALSE(surface.mesh.triangles.empty());
    EXPECT_EQ(*std::max_element(surface.mesh.instances.begin(), surface.mesh.instances.end()), 0u);
    EXPECT_EQ(*std::max_element(surface.mesh.classes.begin(), surface.mesh.classes.end()), 0u);
    EXPECT_TRUE(surface.instance_scores.empty());
  }
}

TEST(MapSurface, MeshesMovedSubmapsByThemselves) {
  Map map = EmptyMap();
  const SubmapId moved = AddThing(map, 1);
  AddPlane(map, moved, 0, 16);
  map.FindMutable(moved)->mutable_info().T_map_submap.translation() = Eigen::Vector3d(0, 0, 1);
  const Mesh mesh = SurfaceOf(map, SurfaceKind::kOneField).mesh;
  ASSERT_FALSE(mesh.vertices_m.empty());
  for (const auto& p : mesh.vertices_m) EXPECT_NEAR(p.z(), 1.1, 1e-4);
}

}  // namespace
}  // namespace dhpmap::evaluator
