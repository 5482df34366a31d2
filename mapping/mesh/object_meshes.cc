// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/object_meshes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "mapping/base/thread_pool.h"
#include "mapping/mesh/surface_extractor.h"
#include "mapping/mesh/surface_field.h"

namespace dhpmap {
namespace {

constexpr std::uint32_t kNoVertex = 0xFFFFFFFFu;

std::optional<Mesh> MeshOf(std::span<const Submap* const> submaps, const FieldScope& scope, const LabelSet& label_set,
                           MeshColoring coloring, const std::stop_token& stop) {
  ThreadPool here(1);  // takes at most one core from mapping
  const SurfaceField field(submaps, here, scope);
  const SurfaceExtractor surface(field, label_set, coloring, here, stop);
  if (stop.stop_requested()) return std::nullopt;
  Mesh mesh;
  ResizeVertices(surface.FirstVertex(surface.num_blocks()), mesh);
  mesh.triangles.resize(surface.FirstTriangle(surface.num_blocks()));
  for (std::size_t block = 0; block < surface.num_blocks() && !stop.stop_requested(); ++block) {
    surface.MakeVertices(block, 0, mesh);
    surface.MakeTriangles(block, 0, mesh);
  }
  if (stop.stop_requested()) return std::nullopt;
  return mesh;
}

/// The submap that owns the triangle.
std::uint32_t OwnerOf(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const std::uint32_t a = mesh.instances[triangle[0]], b = mesh.instances[triangle[1]], c = mesh.instances[triangle[2]];
  if (a == b || a == c) return a;
  return b == c ? b : std::min({a, b, c});
}

/// Adds a triangle of `whole` to `part`. `numbers`: indices of the vertices of `whole` that `part` already has.
void AddTriangle(const Mesh& whole, const std::array<std::uint32_t, 3>& triangle, std::vector<std::uint32_t>& numbers,
                 Mesh& part) {
  std::array<std::uint32_t, 3> own;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t from = triangle[k];
    if (numbers[from] == kNoVertex) {
      numbers[from] = static_cast<std::uint32_t>(part.vertices_m.size());
      part.vertices_m.push_back(whole.vertices_m[from]);
      part.normals.push_back(whole.normals[from]);
      part.colors.push_back(whole.colors[from]);
      part.classes.push_back(whole.classes[from]);
      part.instances.push_back(whole.instances[from]);
    }
    own[k] = numbers[from];
  }
  part.triangles.push_back(own);
}

using TrianglesOf = std::map<std::uint32_t, std::vector<std::size_t>>;

/// Partitions the surface: the triangles of each submap.
TrianglesOf CutByOwner(const Mesh& mesh) {
  TrianglesOf triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) triangles[OwnerOf(mesh, mesh.triangles[t])].push_back(t);
  return triangles;
}

Mesh PartOf(const Mesh& whole, const std::vector<std::size_t>& triangles, std::vector<std::uint32_t>& numbers) {
  Mesh part;
  for (const std::size_t t : triangles) AddTriangle(whole, whole.triangles[t], numbers, part);
  for (const std::size_t t : triangles) {
    for (const std::uint32_t vertex : whole.triangles[t]) numbers[vertex] = kNoVertex;
  }
  return part;
}

}  // namespace

std::vector<ObjectMesh> ExtractObjectMeshes(const MapSnapshot& map, std::span<const Submap* const> wanted,
                                            MeshColoring coloring, const std::stop_token& stop) {
  return ExtractObjectMeshes(map, wanted, MeshSourcesOf(map, wanted), coloring, stop);
}

std::vector<ObjectMesh> ExtractObjectMeshes(const MapSnapshot& map, std::span<const Submap* const> wanted,
                                            const MeshSources& sources, MeshColoring coloring,
                                            const std::stop_token& stop) {
  const LabelSet& label_set = *map.info().label_set;
  std::optional<Mesh> whole = Mesh();
  if (!sources.on_grid.empty()) {
    whole = MeshOf(sources.around, {.blocks = &sources.blocks, .is_in_own_frame = true}, label_set, coloring, stop);
  }
  if (!whole) return {};
  const TrianglesOf triangles = CutByOwner(*whole);
  std::vector<std::uint32_t> numbers(whole->vertices_m.size(), kNoVertex);
  std::vector<ObjectMesh> meshes;
  for (const Submap* submap : wanted) {
    ObjectMesh object{submap->id(), {}};
    if (!IsCutFromMap(map, *submap)) {
      auto alone = MeshOf({&submap, 1}, {.is_in_own_frame = true}, label_set, coloring, stop);
      if (!alone) return {};
      object.mesh = *std::move(alone);
    } else if (const auto own = triangles.find(submap->id().value); own != triangles.end()) {
      object.mesh = PartOf(*whole, own->second, numbers);
    }
    meshes.push_back(std::move(object));
  }
  return meshes;
}

}  // namespace dhpmap
