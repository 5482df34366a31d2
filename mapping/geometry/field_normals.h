// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/geometry/triangle_packet.h"

namespace dhpmap {

/// Normals of corners and edges that triangles share: at a corner those of all that meet there, each weighted with its
/// angle, at an edge of both; and whether surfaces go on there. Corners are one if they agree to a tenth of a
/// millimetre. Coordinates within 50 m.
class FieldNormals {
 public:
  /// Of so many triangles.
  explicit FieldNormals(std::size_t num_triangles);

  /// Positions in sums().
  struct Places {
    std::array<std::uint32_t, 3> corners, edges;  ///< an edge goes from its corner to the next
  };
  Places Want(const TriangleCorners& triangle);
  /// Adds a triangle of a surface to all that is wanted of it. After everything was wanted.
  void Add(const TriangleCorners& triangle, std::uint32_t surface);

  [[nodiscard]] const std::vector<Eigen::Vector3f>& sums() const { return sums_; }
  /// Whether each surface that has the edge, or an edge at the corner, goes on beyond it, as far as it was added: has
  /// it as often in one direction as in the other.
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
