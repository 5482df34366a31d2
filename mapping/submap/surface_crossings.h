// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Where the distance is zero between two voxels that lie side by side and both show something (BlockEntry::Shows).
struct SurfaceCrossing {
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();  ///< submap frame
  Eigen::Vector3d normal =
      Eigen::Vector3d::UnitZ();  ///< towards where it is seen from: the gradient in the block, of length 1
  float weight = 0;              ///< the lesser of the two voxels'
};

/// All crossings of a submap's surface, tile by tile: some 65 a block of a flat surface. The surface that is drawn
/// (ExtractTileSurface) goes through them, but for where it needs other submaps. Distances are rounded as the store
/// does it, to 1 / 8192 of the submap's truncation. Throws StatusError if a tile cannot be read; tiles that have to be
/// read for it go again.
std::vector<SurfaceCrossing> FindSurfaceCrossings(const Submap& submap);

}  // namespace dhpmap
