// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "mapping/voxels/block_entry.h"
#include "mapping/voxels/voxel_mask.h"

namespace dhpmap {

// Predicates over all voxels of a block at once, vectorised.

/// Voxels of one z.
inline constexpr std::size_t kLayerVoxels = std::size_t{kBlockSide} * kBlockSide;

/// Bit i: the condition holds for value i, of the 64 values of a layer by LinearIndex.
template <typename Value, typename Condition>
[[nodiscard]] std::uint64_t LayerWhere(const Value* values, Condition&& holds) {
  static_assert(std::endian::native == std::endian::little, "the first of eight bytes has the lowest bits");
  std::array<std::uint8_t, kLayerVoxels> flags;  // one byte each, so that the loop vectorises
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = holds(values[i]) ? 0xFF : 0;
  std::uint64_t layer = 0;
#ifdef __SSE2__
  for (std::size_t i = 0; i < flags.size(); i += sizeof(__m128i)) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&flags[i]));
    layer |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm_movemask_epi8(bytes))) << i;
  }
#else
  constexpr std::uint64_t kLowBits = 0x0101010101010101u, kLowBitsToTop = 0x0102040810204080u;
  for (std::size_t i = 0; i < flags.size(); i += 8) {
    std::uint64_t bytes;
    std::memcpy(&bytes, &flags[i], sizeof(bytes));
    layer |= ((bytes & kLowBits) * kLowBitsToTop >> 56) << i;
  }
#endif
  return layer;
}

/// The same for a whole block.
template <typename Value, typename Condition>
[[nodiscard]] VoxelMask MaskWhere(const std::array<Value, kBlockVoxels>& values, Condition&& holds) {
  VoxelMask mask;
  for (std::size_t z = 0; z < mask.size(); ++z) mask[z] = LayerWhere(&values[kLayerVoxels * z], holds);
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
