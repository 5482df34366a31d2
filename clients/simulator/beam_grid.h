// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "clients/simulator/bounding_tree.h"
#include "mapping/base/transform.h"
#include "mapping/sensor/pinhole_camera.h"

namespace dhpmap::simulator {

/// The solids visible from each tile of an image, so that neighbouring rays share the traversal of the tree. Immutable.
class BeamGrid {
 public:
  /// The tree must outlive the grid.
  BeamGrid(const BoundingTree& tree, const PinholeCamera& camera, const Transform& T_map_camera);

  /// The first solid on the ray of a point in pixel (u, v), as by BoundingTree::Cast.
  [[nodiscard]] BoundingTree::Hit Cast(int u_px, int v_px, const Ray& ray) const;

 private:
  static constexpr int kTile_px = 8;

  int num_columns_;
  std::vector<BoundingTree::Candidate> candidates_;  ///< tile by tile, nearest first
  std::vector<std::uint32_t> first_;                 ///< for each tile, and the end
};

}  // namespace dhpmap::simulator
