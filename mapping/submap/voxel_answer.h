// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <compare>

#include "mapping/submap/submap.h"

// The answer of a submap for one of its voxels, shared by point queries and meshes. `block` is one of the submap's and
// has geometry; `linear` is an observed voxel of it.

namespace dhpmap {

/// A voxel has the class of its submap: a vote over the whole object is right more often than one over a voxel (PQ of a
/// house 0.87 against 0.84). Count and share are those of this class in the voxel's labels, 0 if they were dropped.
/// Class 0 for the unknown submap.
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

/// Weight of a submap's answer at a position that several hold, before label management. The greatest wins; ties go to
/// the smaller id.
struct VoxelSupport {
  float observations = 0;  ///< discounted by the distance to the surface
  bool is_known = false;   ///< the unknown submap answers only if no other does
  float weight = 0;
  auto operator<=>(const VoxelSupport&) const = default;
};

/// Observations are discounted by the distance to the submap's surface, so that an object keeps the points on it even
/// if the wall behind was seen more often. Right class on ground-truth frames of a house: 97.8 % instead of 96.9 % by
/// counts alone.
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
