// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>

#include "mapping/base/thread_pool.h"
#include "mapping/mesh/mesh.h"
#include "mapping/mesh/surface_field.h"

namespace dhpmap {

/// Marching cubes over one field (Lorensen and Cline 1987), in two passes. The first finds cells with surface, in a few
/// bits per voxel. The second makes the vertices and triangles of any block, in any order. So a mesh can be counted
/// before it is made, and made piece by piece. The const functions may run on several threads at once.
class SurfaceExtractor {
 public:
  /// The field and the label set outlive this. Finds all cells whose 8 corners are observed and that the surface
  /// crosses, and numbers vertices and triangles by block, then by edge or cell. Ends early after a `stop` request;
  /// then no other function may be called.
  SurfaceExtractor(const SurfaceField& field, const LabelSet& label_set, MeshColoring coloring, ThreadPool& pool,
                   const std::stop_token& stop = {});
  ~SurfaceExtractor();
  SurfaceExtractor(SurfaceExtractor&&) noexcept;

  [[nodiscard]] std::size_t num_blocks() const;
  /// Number of the first vertex or triangle of a block; for block num_blocks(): the total.
  [[nodiscard]] std::size_t FirstVertex(std::size_t block) const;
  [[nodiscard]] std::size_t FirstTriangle(std::size_t block) const;

  /// Writes the block's vertices or triangles into `part`, whose vectors are large enough and begin with vertex, or
  /// triangle, `first`. Triangles refer to vertices by their numbers in the whole mesh.
  void MakeVertices(std::size_t block, std::size_t first, Mesh& part) const;
  void MakeTriangles(std::size_t block, std::size_t first, Mesh& part) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Resize the vectors of `part` for this number of vertices, or of triangles.
void ResizeVertices(std::size_t num_vertices, Mesh& part);

}  // namespace dhpmap
