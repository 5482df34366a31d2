// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/refinement_scratch.h"
#include "mapping/refinement/tile_problem.h"

namespace dhpmap {

/// An offset at which a voxel's observations are evidence, too.
struct NearTap {
  std::int8_t x, y, z;  ///< voxels
  float weight;
};

/// The sparse kernel of Melkumyan and Ramos (2009), as semantic BKI mapping has it: 1 at 0, falling to 0 at the radius,
/// which is limited to 8 voxels, a block's side. Without the voxel itself.
std::vector<NearTap> NearTaps(double radius_vox);

/// Evidence for the instances of a tile's voxels, by member, then channel: the parameters of a Dirichlet distribution
/// minus its prior. A voxel's own observations count fully. Observations of voxels at the surface (within 1.5 voxels),
/// where labels are reliable, also count for the voxels around them: `kNearWeight` times the kernel. The result depends
/// on the tile alone.
inline constexpr float kNearWeight = 0.3f;
ScratchVector<float> GatherEvidence(const TileProblem& problem, double radius_vox, double voxel_size_m);

}  // namespace dhpmap
