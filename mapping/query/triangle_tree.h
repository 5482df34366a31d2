// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "mapping/query/box_tree.h"

namespace dhpmap {

using TriangleCorners = std::array<Eigen::Vector3f, 3>;

/// The point of a triangle that is nearest to `p`.
Eigen::Vector3f NearestPointOf(const TriangleCorners& triangle, const Eigen::Vector3f& p);

/// Triangles of one surface, a few metres wide, for exact questions about it. Coordinates in metres of one frame,
/// corners counter-clockwise seen from the front. Immutable, thread-safe.
class TriangleTree {
 public:
  explicit TriangleTree(std::vector<TriangleCorners> triangles);

  [[nodiscard]] std::size_t num_triangles() const { return triangles_.size(); }
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return tree_.bounds(); }
  [[nodiscard]] std::size_t MemoryBytes() const;

  /// Of their boxes; position i in it is triangle(i).
  [[nodiscard]] const BoxTree& tree() const { return tree_; }
  [[nodiscard]] const TriangleCorners& triangle(std::size_t position) const { return triangles_[position]; }

 private:
  BoxTree tree_;
  std::vector<TriangleCorners> triangles_;  ///< in the order of the tree
};

}  // namespace dhpmap
