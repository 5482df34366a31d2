// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// The mesh of ExtractMesh or ExtractMapMesh in pieces, with the same vertices and triangles in the same order. How
/// many there are is known beforehand, and only one piece is in memory. Keeps the state it is made from alive. Belongs
/// to one thread.
class MeshStream {
 public:
  /// Of one submap, or without one of the whole map. Counts, which takes about half the time of meshing; after a `stop`
  /// requested meanwhile the stream is empty.
  MeshStream(std::shared_ptr<const MapSnapshot> map, const Submap* submap, MeshColoring coloring,
             const std::stop_token& stop = {});
  ~MeshStream();
  MeshStream(MeshStream&&) noexcept;

  [[nodiscard]] std::size_t num_vertices() const;
  [[nodiscard]] std::size_t num_triangles() const;

  /// The next piece, of some thousand vertices without triangles; its vectors are used again. False: there is none.
  bool NextVertices(Mesh& piece);
  /// The next piece, of triangles without vertices, which they number through the whole mesh. False: there is none.
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
