// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/mesh_stream.h"

#include <utility>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map_grid.h"
#include "mapping/mesh/surface_extractor.h"
#include "mapping/mesh/surface_field.h"

namespace dhpmap {
namespace {

/// A piece consists of whole blocks and ends after this many vertices or triangles; its last block adds at most 1,536
/// and 2,560.
constexpr std::size_t kPieceVertices = 4096;
constexpr std::size_t kPieceTriangles = 8192;

}  // namespace

/// Submaps that share a grid, meshed as one field.
struct MeshStream::Layer {
  SurfaceField field;
  SurfaceExtractor surface;
  std::size_t first_vertex;    ///< in the whole mesh
  std::size_t first_triangle;  ///< in the whole mesh

  [[nodiscard]] std::size_t num_vertices() const { return surface.FirstVertex(surface.num_blocks()); }
  [[nodiscard]] std::size_t num_triangles() const { return surface.FirstTriangle(surface.num_blocks()); }

  Layer(const std::vector<const Submap*>& submaps, const LabelSet& label_set, MeshColoring coloring, ThreadPool& pool,
        const std::stop_token& stop)
      : field(submaps, pool), surface(field, label_set, coloring, pool, stop), first_vertex(0), first_triangle(0) {}
};

MeshStream::MeshStream(std::shared_ptr<const MapSnapshot> map, const Submap* submap, MeshColoring coloring,
                       const std::stop_token& stop)
    : map_(std::move(map)) {
  if (submap != nullptr) {
    AddLayer({submap}, coloring, stop);
  } else {
    // As ExtractMapMesh: submaps on the map's grid as one field, others separately.
    std::vector<const Submap*> on_grid, others;
    for (const auto& each : map_->submaps()) {
      if (each->IsAbsent()) continue;
      (IsExclusive(each->info(), map_->info().config) ? on_grid : others).push_back(each.get());
    }
    if (!on_grid.empty()) AddLayer(on_grid, coloring, stop);
    for (const Submap* other : others) AddLayer({other}, coloring, stop);
  }
  if (stop.stop_requested()) layers_.clear();
}

MeshStream::~MeshStream() = default;
MeshStream::MeshStream(MeshStream&&) noexcept = default;

void MeshStream::AddLayer(const std::vector<const Submap*>& submaps, MeshColoring coloring,
                          const std::stop_token& stop) {
  if (stop.stop_requested()) return;
  ThreadPool here(1);  // an export takes at most one core from mapping, except for reading
  auto layer = std::make_unique<Layer>(submaps, *map_->info().label_set, coloring, here, stop);
  layer->first_vertex = num_vertices();
  layer->first_triangle = num_triangles();
  layers_.push_back(std::move(layer));
}

std::size_t MeshStream::num_vertices() const {
  return layers_.empty() ? 0 : layers_.back()->first_vertex + layers_.back()->num_vertices();
}

std::size_t MeshStream::num_triangles() const {
  return layers_.empty() ? 0 : layers_.back()->first_triangle + layers_.back()->num_triangles();
}

bool MeshStream::NextVertices(Mesh& piece) {
  for (; vertices_.layer < layers_.size(); vertices_ = {vertices_.layer + 1, 0}) {
    const SurfaceExtractor& surface = layers_[vertices_.layer]->surface;
    const std::size_t begin = vertices_.block, first = surface.FirstVertex(begin);
    std::size_t& end = vertices_.block;
    while (end < surface.num_blocks() && surface.FirstVertex(end) < first + kPieceVertices) ++end;
    if (surface.FirstVertex(end) == first) continue;  // the layer is complete
    piece.triangles.clear();
    ResizeVertices(surface.FirstVertex(end) - first, piece);
    for (std::size_t block = begin; block < end; ++block) surface.MakeVertices(block, first, piece);
    return true;
  }
  return false;
}

bool MeshStream::NextTriangles(Mesh& piece) {
  for (; triangles_.layer < layers_.size(); triangles_ = {triangles_.layer + 1, 0}) {
    const Layer& layer = *layers_[triangles_.layer];
    const SurfaceExtractor& surface = layer.surface;
    const std::size_t begin = triangles_.block, first = surface.FirstTriangle(begin);
    std::size_t& end = triangles_.block;
    while (end < surface.num_blocks() && surface.FirstTriangle(end) < first + kPieceTriangles) ++end;
    if (surface.FirstTriangle(end) == first) continue;
    ResizeVertices(0, piece);
    piece.triangles.resize(surface.FirstTriangle(end) - first);
    for (std::size_t block = begin; block < end; ++block) surface.MakeTriangles(block, first, piece);
    const auto offset = static_cast<std::uint32_t>(layer.first_vertex);
    for (auto& triangle : piece.triangles) {
      for (std::uint32_t& vertex : triangle) vertex += offset;
    }
    return true;
  }
  return false;
}

}  // namespace dhpmap
