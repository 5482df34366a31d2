// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "clients/simulator/solid.h"

namespace dhpmap::simulator {

/// Bounding-volume hierarchy over solids, for rays and for nearest-solid queries. Immutable, keeps its own copy of the
/// solids in the order of its leaves.
class BoundingTree {
 public:
  struct Hit {
    double distance_m;   ///< along the ray
    const Solid* solid;  ///< lives as long as the tree
  };
  struct Nearest {
    double distance_m;  ///< signed
    const Solid* solid;
  };

  explicit BoundingTree(std::vector<Solid> solids);

  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }
  /// First solid that the ray enters within max_m; solid is null if there is none.
  [[nodiscard]] Hit Cast(const Ray& ray, double max_m) const;
  /// Signed distance to the union of solids: exact outside, a bound inside.
  [[nodiscard]] Nearest Closest(const Eigen::Vector3d& p) const;

 private:
  struct Node {
    Eigen::Array4f min, max;  ///< bounds in x, y, z; the fourth lane lets a ray test be one operation on all lanes
    std::uint32_t first;      ///< leaf: first solid; else the right child (the left one is the next node)
    std::uint32_t count;      ///< of solids in a leaf; 0 = inner node
  };
  struct FastRay;

  std::uint32_t Build(std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] static double DistanceToNode(const Node& node, const Eigen::Vector3d& p);
  [[nodiscard]] std::uint32_t Partition(std::uint32_t begin, std::uint32_t end);

  std::vector<Solid> solids_;
  std::vector<Eigen::AlignedBox3d> bounds_;  ///< only while building
  std::vector<Node> nodes_;
};

}  // namespace dhpmap::simulator
