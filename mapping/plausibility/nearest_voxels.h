// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Of all submaps' voxels that a point is in, the one whose centre is nearest to its surface. Looks into the map, which
/// nobody may change meanwhile.
struct NearestVoxel {
  float centre_distance_m = std::numeric_limits<float>::infinity();  ///< without sign
  const BlockEntry* block = nullptr;                                 ///< null: none says anything of a surface
  int linear = 0;
  Eigen::Vector3f off_vox = Eigen::Vector3f::Zero();  ///< of the point, from the centre

  [[nodiscard]] bool IsInBand() const { return block != nullptr; }
  /// From the surface, negative behind it; of a point in a band.
  [[nodiscard]] float DistanceOfPoint() const;
};

/// One for each point; these are within the reach of the map's grid. Throws StatusError where tiles cannot be read.
std::vector<NearestVoxel> FindNearestVoxels(std::span<const Eigen::Vector3d> points_map_m, const Map& map);

}  // namespace dhpmap
