// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/geometry/triangle_packet.h"

namespace dhpmap {

/// Normals of shared corners and edges: at a corner weighted by the angles of all adjacent triangles, at an edge the
/// mean of both; and whether surfaces continue there. Corners within 0.1 mm are one. Coordinates within 50 m.
class FieldNormals {
 public:
  /// For a number of triangles.
  explicit FieldNormals(std::size_t num_triangles);

  /// Positions in sums().
  struct Places {
    std::array<std::uint32_t, 3> corners, edges;  ///< an edge goes from its corner to the next
  };
  Places Want(const TriangleCorners& triangle);
  /// Adds a triangle of a surface to its registered corners and edges; only after all are registered.
  void Add(const TriangleCorners& triangle, std::uint32_t surface);

  [[nodiscard]] const std::vector<Eigen::Vector3f>& sums() const { return sums_; }
  /// Whether each surface with this edge, or with an edge at this corner, continues beyond it, as far as added: it has
  /// the edge equally often in both directions.
  [[nodiscard]] bool GoesOn(std::uint32_t place) const { return ends_[place] == 0; }

 private:
  struct Entry {
    std::uint64_t key;  ///< 0: empty
    std::uint32_t place;
  };
  static std::uint64_t KeyOf(const Eigen::Vector3f& corner);
  static std::uint64_t KeyOf(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] Entry& Find(std::uint64_t key);
  std::uint32_t PlaceOf(std::uint64_t key);

  std::vector<Entry> entries_;  ///< open addressing, a power of two
  std::vector<Eigen::Vector3f> sums_;
  std::vector<std::uint64_t> ends_;  ///< sums of a hash of each edge and surface, and of its negative the other way
};

}  // namespace dhpmap
