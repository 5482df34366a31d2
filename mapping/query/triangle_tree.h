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

/// The nearest point found so far on a surface, and how far to look.
struct NearestSurface {
  float distance2_m2 = 0;  ///< before anything is found: the limit
  float side = 0;          ///< positive: the asker is before the surface; negative: behind it
  Eigen::Vector3f point_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, to the front

  /// Squared distance within which a triangle may still be as near: an edge or a corner belongs to several, which say
  /// together on which side the asker is. A micrometre or so, for rounding.
  [[nodiscard]] float Limit2() const { return distance2_m2 * (1 + 2e-5f) + 1e-9f; }
};

/// Triangles of one surface, a few metres wide, for exact questions about it. Coordinates in metres of one frame,
/// corners counter-clockwise seen from the front. Immutable, thread-safe.
class TriangleTree {
 public:
  explicit TriangleTree(std::vector<TriangleCorners> triangles);

  [[nodiscard]] std::size_t num_triangles() const { return triangles_.size(); }
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return tree_.bounds(); }
  [[nodiscard]] std::size_t MemoryBytes() const;

  /// Looks for a point that is nearer to `p` than `best`. Returns whether there is one: then `best` is in the frame of
  /// these triangles. If not, they may still have changed its side.
  bool ImproveNearest(const Eigen::Vector3f& p, NearestSurface& best) const;

 private:
  BoxTree tree_;
  std::vector<TriangleCorners> triangles_;  ///< in the order of the tree
};

}  // namespace dhpmap
