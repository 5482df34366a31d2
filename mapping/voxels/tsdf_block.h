// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/base/grid.h"
#include "mapping/labels/color.h"
#include "mapping/voxels/part_id.h"

namespace dhpmap {

/// A voxel below this weight is unobserved, and its distance is meaningless.
inline constexpr float kMinObservedWeight = 1e-6f;

/// Geometry of one block (paper II-A): planes of kBlockVoxels values, indexed by LinearIndex. 11 bytes a voxel.
struct TsdfBlock {
  /// Projective signed distance to the surface in metres, positive in front of it, within +-truncation.
  std::array<float, kBlockVoxels> distance_m{};
  std::array<float, kBlockVoxels> weight{};
  std::array<Color, kBlockVoxels> color{};
  PartId part_id;

  [[nodiscard]] bool IsObserved(int linear) const { return weight[linear] >= kMinObservedWeight; }
  [[nodiscard]] bool HasObservedVoxel() const;
  [[nodiscard]] int NumObservedVoxels() const;
  [[nodiscard]] std::size_t MemoryBytes() const { return sizeof(*this); }

  // Blocks made by `new`, as those of maps are, are counted as MemoryKind::kBlocks.
  static void* operator new(std::size_t bytes);
  static void operator delete(void* block, std::size_t bytes);
};

}  // namespace dhpmap
