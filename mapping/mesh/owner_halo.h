// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/mesh/halo.h"
#include "mapping/mesh/surface_field.h"

namespace dhpmap {

/// Which submap answers for the voxels of a block and one voxel around it.
class OwnerHalo {
 public:
  /// False if one submap has all the blocks: then it answers everywhere, and no halo is needed.
  [[nodiscard]] static bool IsNeeded(const SurfaceField& field, const Halo::Blocks& blocks);
  OwnerHalo(const SurfaceField& field, const Halo::Blocks& blocks);

  /// The position of the voxel that labels a vertex on the edge between two neighbours along `axis`: of the submap that
  /// has most of the 18 corners of the four cells around the edge, of equals the nearer end's. The voxel is the nearer
  /// end of the edge if that is of this submap, else the farther one, else one around. The unknown submap has no say
  /// where a known one has a corner.
  ///
  /// The nearer end alone would speckle borders, as the voxels in front of a surface and behind it often are different
  /// submaps'. Measured with label management alone, nearer end against this: PQ 0.776 / 0.814 on a house (run1),
  /// 0.353 / 0.366 and 0.252 / 0.258 on kitti 07 and 00.
  [[nodiscard]] int Labelling(int nearer, int farther, int axis) const;

 private:
  std::array<std::uint32_t, Halo::kVoxels> owner_{};  ///< id; 0 = not observed, or the unknown submap's
};

}  // namespace dhpmap
