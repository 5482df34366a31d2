// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mapping/geometry/box_tree.h"
#include "mapping/geometry/triangle_packet.h"
#include "mapping/mesh/tile_surface.h"

namespace dhpmap {

/// The point of a triangle nearest to `p`.
Eigen::Vector3f NearestPointOf(const TriangleCorners& triangle, const Eigen::Vector3f& p);

/// Triangles of one surface, a few metres wide, for exact queries. Coordinates in metres of one frame, corners
/// counter-clockwise seen from the front. Immutable, thread-safe.
class TriangleTree {
 public:
  explicit TriangleTree(std::vector<TriangleCorners> triangles)
      : TriangleTree(TileSurface{std::move(triangles), {}, {}}) {}
  explicit TriangleTree(TileSurface surface);

  [[nodiscard]] std::size_t num_triangles() const { return tree_.items().size(); }
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return tree_.bounds(); }
  [[nodiscard]] std::size_t MemoryBytes() const;

  /// Tree of the triangles' boxes, eight to a leaf: leaf i is packet(i), and item i of it triangle(i).
  [[nodiscard]] const BoxTree& tree() const { return tree_; }
  [[nodiscard]] const TrianglePacket& packet(std::size_t leaf) const { return packets_[leaf]; }
  [[nodiscard]] TriangleCorners triangle(std::size_t position) const {
    return packets_[position / TrianglePacket::kLanes].Get(position % TrianglePacket::kLanes);
  }
  /// Other submaps on whose presence a triangle depends; mostly none.
  [[nodiscard]] std::span<const SubmapId> NeededBy(std::size_t position) const {
    if (needs_.empty()) return {};
    return needed_[needs_[position]];
  }
  /// Whether any triangle depends on another submap.
  [[nodiscard]] bool has_needs() const { return !needs_.empty(); }
  /// Prefetches a packet.
  void PrefetchPacket(std::size_t leaf) const {
    const auto* first = reinterpret_cast<const char*>(&packets_[leaf]);
    for (std::size_t at = 0; at < sizeof(TrianglePacket); at += 64) __builtin_prefetch(first + at);
  }

 private:
  BoxTree tree_;
  std::vector<TrianglePacket> packets_;  ///< in the order of the tree
  std::vector<std::uint16_t> needs_;     ///< likewise, index into needed_; empty: no dependencies
  std::vector<std::vector<SubmapId>> needed_;
};

}  // namespace dhpmap
