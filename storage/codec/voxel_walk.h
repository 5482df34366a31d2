// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "mapping/base/grid.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// Mask of the written voxels of a block: one bit a voxel, lowest first.
using VoxelBits = std::array<std::uint8_t, kBlockVoxels / 8>;

inline void MaskVoxel(VoxelBits& mask, int linear) {
  mask[linear / 8] |= static_cast<std::uint8_t>(1u << (linear % 8));
}
inline bool IsMasked(const VoxelBits& mask, int linear) { return (mask[linear / 8] >> (linear % 8)) & 1u; }

static_assert(sizeof(VoxelBits) % sizeof(std::uint64_t) == 0, "counted a word at a time");
/// `mask`: the bytes of VoxelBits, one or several.
inline std::size_t NumMasked(ByteView mask) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, mask.data() + i, sizeof(word));
    count += static_cast<std::size_t>(std::popcount(word));
  }
  return count;
}

/// Visits the masked voxels in order and predicts each value from earlier ones, for writer and reader alike; the
/// differences are stored. Values live in a grid with a border, so that neighbours need no bounds checks.
class VoxelWalk {
 public:
  static constexpr int kGridSide = kBlockSide + 1;
  static constexpr int kGridSize = kGridSide * kGridSide * kGridSide;
  /// Values by Site::cell. The border holds zeros.
  template <typename Value>
  using GridOf = std::array<Value, kGridSize>;
  using Grid = GridOf<std::int32_t>;

  struct Site {
    std::uint16_t linear;  ///< voxel in its block
    std::uint16_t cell;    ///< its position in a Grid
    std::uint16_t near;    ///< position of the masked lower neighbour in x, else y, else z, else of the previous site
    std::uint8_t faces;    ///< bits xy, xz, yz: the three lower neighbours in that plane are all masked
  };

  explicit VoxelWalk(const VoxelBits& mask);
  [[nodiscard]] std::span<const Site> sites() const { return {sites_.data(), num_sites_}; }

  /// A reusable grid of the calling thread, for one walk. Its border holds zeros, everything else stale values:
  /// predictions only read values written by this walk. Clearing a new grid for each walk would take longer than
  /// reading the 200 voxels of a typical block.
  enum class Scratch : std::uint8_t { kFirst, kSecond };
  static Grid& GridOfThread(Scratch which = Scratch::kFirst);

  /// For values with noise: the nearest value.
  static std::int32_t PredictNear(const Grid& grid, const Site& site) { return grid[site.near]; }
  /// For smooth values: the mean of the parallelograms that the masked neighbours span (Lorenzo predictor). `Value`: a
  /// number, or a vector of numbers with a Quotient(sum, count).
  template <typename Value>
  static Value PredictSmooth(const GridOf<Value>& grid, const Site& site);

 private:
  static constexpr int kStepX = 1, kStepY = kGridSide, kStepZ = kGridSide * kGridSide;
  static constexpr std::uint8_t kXy = 1, kXz = 2, kYz = 4;

  std::array<Site, kBlockVoxels> sites_;
  std::size_t num_sites_ = 0;
};

constexpr std::int32_t Quotient(std::int32_t sum, std::int32_t count) { return sum / count; }

template <typename Value>
Value VoxelWalk::PredictSmooth(const GridOf<Value>& grid, const Site& site) {
  if (site.faces == 0) return grid[site.near];
  const Value* value = grid.data() + site.cell;
  const Value x = value[-kStepX], y = value[-kStepY], z = value[-kStepZ];
  Value sum{};
  std::int32_t count = 0;
  if (site.faces & kXy) sum = sum + x + y - value[-kStepX - kStepY], ++count;
  if (site.faces & kXz) sum = sum + x + z - value[-kStepX - kStepZ], ++count;
  if (site.faces & kYz) sum = sum + y + z - value[-kStepY - kStepZ], ++count;
  return count == 1 ? sum : Quotient(sum, count);
}

// Maps signed differences to small unsigned numbers; exactly invertible, modulo 2^32.
constexpr std::uint32_t ZigZag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}
constexpr std::int32_t UnZigZag(std::uint32_t value) {
  return static_cast<std::int32_t>((value >> 1) ^ (~(value & 1u) + 1u));
}

}  // namespace dhpmap
