// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>

#include "mapping/base/thread_pool.h"
#include "mapping/mesh/mesh.h"
#include "mapping/mesh/surface_field.h"

namespace dhpmap {

/// Marching cubes over one field (Lorensen and Cline 1987), in two passes: first what there is, in a few bits a voxel;
/// then the vertices and triangles of any block, in any order. So a mesh can be counted before it is made, and made
/// piece by piece. The const functions may run on several threads at once.
class SurfaceExtractor {
 public:
  /// The field and the label set outlive it. Finds all cells whose 8 corners are observed and that the surface crosses,
  /// and numbers vertices and triangles by block, then by edge or cell. Once `stop` is requested it ends early; then
  /// nothing else may be called.
  SurfaceExtractor(const SurfaceField& field, const LabelSet& label_set, MeshColoring coloring, ThreadPool& pool,
                   const std::stop_token& stop = {});
  ~SurfaceExtractor();
  SurfaceExtractor(SurfaceExtractor&&) noexcept;

  [[nodiscard]] std::size_t num_blocks() const;
  /// Number of the first vertex or triangle of a block; of block num_blocks(): how many there are in all.
  [[nodiscard]] std::size_t FirstVertex(std::size_t block) const;
  [[nodiscard]] std::size_t FirstTriangle(std::size_t block) const;

  /// Writes what the block owns into `part`, whose vectors are large enough and begin with vertex, or triangle,
  /// `first`. Triangles refer to vertices by their numbers in the whole.
  void MakeVertices(std::size_t block, std::size_t first, Mesh& part) const;
  void MakeTriangles(std::size_t block, std::size_t first, Mesh& part) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Makes room in `part` for so many vertices, and for so many triangles.
void ResizeVertices(std::size_t num_vertices, Mesh& part);

}  // namespace dhpmap
