// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// The mesh of ExtractMesh or ExtractMapMesh in pieces, with the same vertices and triangles in the same order. The
/// totals are known in advance, and only one piece is in memory. Keeps its state alive. One thread.
class MeshStream {
 public:
  /// For one submap, or the whole map without one. Counts first, which takes about half the time of meshing; empty
  /// after a `stop` request.
  MeshStream(std::shared_ptr<const MapSnapshot> map, const Submap* submap, MeshColoring coloring,
             const std::stop_token& stop = {});
  ~MeshStream();
  MeshStream(MeshStream&&) noexcept;

  [[nodiscard]] std::size_t num_vertices() const;
  [[nodiscard]] std::size_t num_triangles() const;

  /// The next piece: some thousand vertices without triangles; reuses its vectors. False at the end.
  bool NextVertices(Mesh& piece);
  /// The next piece: triangles without vertices, with vertex numbers of the whole mesh. False at the end.
  bool NextTriangles(Mesh& piece);

 private:
  struct Layer;
  struct Cursor {
    std::size_t layer = 0, block = 0;
  };
  void AddLayer(const std::vector<const Submap*>& submaps, MeshColoring coloring, const std::stop_token& stop);

  std::shared_ptr<const MapSnapshot> map_;
  std::vector<std::unique_ptr<Layer>> layers_;
  Cursor vertices_, triangles_;
};

}  // namespace dhpmap
