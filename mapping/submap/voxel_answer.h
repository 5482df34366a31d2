// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <compare>

#include "mapping/submap/submap.h"

// What a submap answers for one of its voxels: the same rules for whoever asks, point queries and meshes alike. `block`
// is one of the submap's and has geometry; `linear` is an observed voxel of it.

namespace dhpmap {

/// A voxel has the class of its submap: an object is one thing, and a vote over all of it is right more often than one
/// over a voxel (PQ of a house 0.87 against 0.84). Count and share are those of this class among what the voxel saw, 0
/// where its labels were dropped. Class 0 for the unknown submap.
inline BestLabel ClassOfVoxel(const Submap& submap, const BlockEntry& block, int linear) {
  const SubmapInfo& info = submap.info();
  if (info.panoptic == Panoptic::kUnknown) return {};
  BestLabel answer{.id = info.class_id.value};
  if (block.labels == nullptr) return answer;
  std::uint64_t total = 0;
  block.labels->VisitClasses(linear, [&](LabelCount seen) {
    total += seen.count;
    if (seen.id == answer.id) answer.count = seen.count;
  });
  if (total > 0) answer.share = static_cast<float>(static_cast<double>(answer.count) / static_cast<double>(total));
  return answer;
}

/// A submap's say at a position that several hold, before label management: the greatest answers, ties go to the
/// smaller id.
struct VoxelSupport {
  float observations = 0;  ///< the fewer count, the farther the surface is
  bool is_known = false;   ///< the unknown submap answers only where nobody else does
  float weight = 0;
  auto operator<=>(const VoxelSupport&) const = default;
};

/// Observations count the less the farther the submap's surface is, so an object keeps the points on it though the wall
/// behind was seen more often. Measured on ground-truth frames of a house, right class: 96.9 % by counts alone, 97.8 %
/// so.
inline VoxelSupport SupportOfVoxel(const Submap& submap, const BlockEntry& block, int linear) {
  const auto i = static_cast<std::size_t>(linear);
  VoxelSupport support{.is_known = submap.id() != kUnknownSubmap, .weight = block.tsdf->weight[i]};
  if (block.labels == nullptr) return support;
  constexpr float kLeastNearness = 0.05f;  // at the border of the band, counts still decide
  const float nearness = 1.0f - std::abs(block.tsdf->distance_m[i]) / static_cast<float>(submap.info().truncation_m);
  support.observations = static_cast<float>(block.labels->NumObservations(linear)) * (nearness + kLeastNearness);
  return support;
}

}  // namespace dhpmap
