// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Among the voxels of all submaps that contain a point, the one whose centre is nearest to its surface. Refers to the
/// map, which must not change meanwhile.
struct NearestVoxel {
  float centre_distance_m = std::numeric_limits<float>::infinity();  ///< without sign
  const BlockEntry* block = nullptr;                                 ///< null: no voxel was observed
  int linear = 0;
  Eigen::Vector3f off_vox = Eigen::Vector3f::Zero();  ///< of the point, from the centre

  [[nodiscard]] bool IsInBand() const { return block != nullptr; }
  /// Distance of a point in a band from the surface, negative behind it.
  [[nodiscard]] float DistanceOfPoint() const;
};

/// One for each point; points must be within the range of the map's grid. Throws StatusError if tiles cannot be read.
std::vector<NearestVoxel> FindNearestVoxels(std::span<const Eigen::Vector3d> points_map_m, const Map& map);

}  // namespace dhpmap
