// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "clients/simulator/fast_box.h"
#include "clients/simulator/solid.h"

namespace dhpmap::simulator {

/// Bounding volume hierarchy of solids, for ray casts and nearest-solid queries. Immutable; owns a copy of the solids
/// in the order of its leaves.
class BoundingTree {
 public:
  struct Hit {
    double distance_m;   ///< along the ray
    const Solid* solid;  ///< valid as long as the tree
  };
  struct Nearest {
    double distance_m;  ///< signed
    const Solid* solid;
  };

  /// The intersection of four half spaces whose planes pass through a point.
  struct Pyramid {
    Eigen::Array4f apex_m;                 ///< the fourth lane is 0, also in `inward`
    std::array<Eigen::Array4f, 4> inward;  ///< normals
  };
  struct Candidate {
    FastBox bounds;
    float nearest_m;  ///< lower bound of the distance from the apex
    const Solid* solid;
  };

  explicit BoundingTree(std::vector<Solid> solids);

  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }
  /// The first solid that the ray enters within max_m; solid is null if there is none.
  [[nodiscard]] Hit Cast(const Ray& ray, double max_m) const;
  /// Appends all solids that may intersect the pyramid.
  void Gather(const Pyramid& pyramid, std::vector<Candidate>& candidates) const;
  /// Signed distance to the union of the solids: exact outside, a bound inside.
  [[nodiscard]] Nearest Closest(const Eigen::Vector3d& p) const;

 private:
  struct Node {
    FastBox box;
    std::uint32_t first;  ///< leaf: first solid; else the right child (the left one is the next node)
    std::uint32_t count;  ///< of solids in a leaf; 0: inner node
  };

  std::uint32_t Build(std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] std::uint32_t Partition(std::uint32_t begin, std::uint32_t end);

  std::vector<Solid> solids_;
  std::vector<Eigen::AlignedBox3d> bounds_;  ///< only during construction
  std::vector<Node> nodes_;
};

}  // namespace dhpmap::simulator
