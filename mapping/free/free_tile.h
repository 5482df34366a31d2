// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/voxels/block_tile.h"

namespace dhpmap {

/// The free voxels of one block.
using FreeMask = VoxelMask;

/// Free voxels of a tile as found by one view.
struct FreeBlocks {
  std::uint64_t full = 0;                     ///< bit c: the whole block at cell c (CellOf) is free
  std::uint64_t mixed = 0;                    ///< bit c: masks[c] applies; disjoint from `full`
  std::array<FreeMask, kTileBlocks> masks{};  ///< valid for the cells of `mixed`

  [[nodiscard]] bool empty() const { return (full | mixed) == 0; }
};

/// The voxels of a tile that sensors have looked through: a bit for a fully free block, 64 bytes for a partly free one;
/// less than a bit a voxel. The form is unique, so equal tiles compare equal. Thread-compatible.
class FreeTile {
 public:
  [[nodiscard]] bool empty() const { return (full_ | mixed_) == 0; }
  /// Bit c: every voxel of the block at cell c is free.
  [[nodiscard]] std::uint64_t full() const { return full_; }
  /// Bit c: some but not all voxels of the block at cell c are free.
  [[nodiscard]] std::uint64_t mixed() const { return mixed_; }
  /// Of the mixed blocks, by ascending cell; none is all zeros or all ones.
  [[nodiscard]] std::span<const FreeMask> masks() const { return masks_; }
  /// Sensor clock of the last view through the tile; may lag a little, see FreeSpace.
  [[nodiscard]] std::int64_t last_seen_ns() const { return last_seen_ns_; }

  /// `linear`: the voxel in the block, see LinearIndex.
  [[nodiscard]] bool IsFree(int cell, int linear) const {
    const std::uint64_t bit = std::uint64_t{1} << cell;
    if ((full_ & bit) != 0) return true;
    if ((mixed_ & bit) == 0) return false;
    return (masks_[PositionOf(cell)][static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0;
  }
  /// The free voxels of the block at a cell.
  [[nodiscard]] FreeMask MaskOf(int cell) const;
  [[nodiscard]] std::int64_t NumFreeVoxels() const;

  /// Whether all of `seen` is free already.
  [[nodiscard]] bool Holds(const FreeBlocks& seen) const;
  /// Adds free voxels. Strong exception safety.
  void Add(const FreeBlocks& seen);
  /// Removes voxels. Strong exception safety.
  void Remove(const FreeBlocks& gone);
  void set_last_seen_ns(std::int64_t stamp_ns) { last_seen_ns_ = stamp_ns; }

  [[nodiscard]] std::size_t MemoryBytes() const { return sizeof(*this) + masks_.capacity() * sizeof(FreeMask); }

  bool operator==(const FreeTile&) const = default;

 private:
  /// Makes the blocks of `full` full, and replaces the masks of those of `in_part` by change(cell, mask).
  template <typename Change>
  void Rewrite(std::uint64_t full, std::uint64_t in_part, Change&& change);
  [[nodiscard]] std::size_t PositionOf(int cell) const {
    return static_cast<std::size_t>(std::popcount(mixed_ & ((std::uint64_t{1} << cell) - 1)));
  }

  std::uint64_t full_ = 0;
  std::uint64_t mixed_ = 0;
  std::int64_t last_seen_ns_ = 0;
  std::vector<FreeMask> masks_;
};

}  // namespace dhpmap
