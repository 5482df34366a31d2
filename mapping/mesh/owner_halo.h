// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/mesh/halo.h"
#include "mapping/mesh/surface_field.h"

namespace dhpmap {

/// The owners (submaps) of the voxels of a block and one voxel around it.
class OwnerHalo {
 public:
  /// False if one submap has all the blocks and therefore owns all voxels.
  [[nodiscard]] static bool IsNeeded(const SurfaceField& field, const Halo::Blocks& blocks);
  OwnerHalo(const SurfaceField& field, const Halo::Blocks& blocks);

  /// The position of the voxel that labels a vertex on the edge between two neighbours along `axis`. Its submap is the
  /// one that owns most of the 18 corners of the four cells around the edge; in a tie, that of the nearer end. The
  /// voxel is the nearer end of the edge if this submap owns it, else the farther end, else a corner around. The
  /// unknown submap counts only if no known submap owns a corner.
  ///
  /// Labels of the nearer end alone would speckle borders, because the voxels in front of and behind a surface often
  /// belong to different submaps. Measured with label management alone, nearer end against this rule: PQ 0.776 / 0.814
  /// on a house (run1), 0.353 / 0.366 and 0.252 / 0.258 on KITTI 07 and 00.
  [[nodiscard]] int Labelling(int nearer, int farther, int axis) const;

 private:
  std::array<std::uint32_t, Halo::kVoxels> owner_{};  ///< id; 0 = not observed, or the unknown submap's
};

}  // namespace dhpmap
