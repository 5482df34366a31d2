// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "mapping/map/block_entry.h"
#include "mapping/map/voxel_mask.h"

namespace dhpmap {

// What holds of the voxels of a block, of all at once: a fraction of what it costs to ask for each.

/// Those of whose value the condition holds, of values by LinearIndex. A comparison is made of several at a time.
template <typename Value, typename Condition>
[[nodiscard]] VoxelMask MaskWhere(const std::array<Value, kBlockVoxels>& values, Condition&& holds) {
  static_assert(std::endian::native == std::endian::little, "the first of eight bytes has the lowest bits");
  constexpr std::uint64_t kLowBitsToTop = 0x0102040810204080u;  // of eight bytes to those of the highest, in order
  std::array<std::uint8_t, kBlockVoxels> flags;                 // a byte each: a loop that is vectorised
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = holds(values[i]) ? 1 : 0;
  VoxelMask mask{};
  for (std::size_t row = 0; row < flags.size() / 8; ++row) {
    std::uint64_t bytes;
    std::memcpy(&bytes, flags.data() + 8 * row, sizeof(bytes));
    mask[row / kBlockSide] |= (bytes * kLowBitsToTop >> 56) << (8 * (row % kBlockSide));
  }
  return mask;
}

/// The voxels that BlockEntry::Shows. Needs a TSDF.
[[nodiscard]] inline VoxelMask ShownMask(const BlockEntry& entry) {
  VoxelMask shown = MaskWhere(entry.tsdf->weight, [](float weight) { return weight >= kMinObservedWeight; });
  if (entry.gone == nullptr) return shown;
  const VoxelMask contradicted = entry.gone->Contradicted();
  for (std::size_t z = 0; z < shown.size(); ++z) shown[z] &= ~contradicted[z];
  return shown;
}

}  // namespace dhpmap
