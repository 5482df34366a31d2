// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "mapping/free/free_tile.h"
#include "mapping/space/cell.h"

namespace dhpmap {

/// Tests one tile from large cells to small ones. A result for a cell holds for all its voxels, so the outcome is that
/// of testing each voxel, except that whole blocks or octants that are free in `known` are skipped. `View` is
/// CameraView or LidarView.
template <typename View>
class TileLook {
 public:
  /// `known`: voxels that are free already; null: none. `confirms`: find at least one free block or voxel, known or
  /// not, to show whether the view looks through the tile.
  TileLook(const View& view, const FreeTile* known, bool confirms, FreeBlocks& seen)
      : view_(view), known_(known), confirms_(confirms), seen_(seen) {}

  /// `x`, `y`, `z`: the tile's centre. Its sight is kFree or kMixed.
  void Look(CellSight sight, float x, float y, float z) {
    seen_.full = seen_.mixed = 0;
    if (sight == CellSight::kFree) {
      seen_.full = ~std::uint64_t{0};
      return;
    }
    const CellBatch eighths = ChildrenOf(CellSize::kTile, x, y, z);
    CellSights sights;
    view_.Classify(eighths, sights);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::uint64_t blocks = BlocksOf(i);
      if (sights[i] == CellSight::kFree) {
        seen_.full |= blocks;
      } else if (sights[i] == CellSight::kMixed && !IsKnown(blocks)) {
        LookAtEighth(i, eighths.x[i], eighths.y[i], eighths.z[i]);
      }
    }
  }

 private:
  /// Cell of the tile (see CellOf) of the block `child` of an eighth.
  static std::size_t CellIn(std::size_t eighth, std::size_t child) {
    std::size_t cell = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      cell |= (2 * (eighth >> axis & 1u) + (child >> axis & 1u)) << (2 * axis);
    }
    return cell;
  }
  static std::uint64_t BlocksOf(std::size_t eighth) {
    std::uint64_t blocks = 0;
    for (std::size_t child = 0; child < kLanes; ++child) blocks |= std::uint64_t{1} << CellIn(eighth, child);
    return blocks;
  }
  /// Whether these blocks can be skipped.
  [[nodiscard]] bool IsKnown(std::uint64_t blocks) const {
    return known_ != nullptr && (known_->full() & blocks) == blocks && !(confirms_ && seen_.empty());
  }

  void LookAtEighth(std::size_t eighth, float x, float y, float z) {
    const CellBatch blocks = ChildrenOf(CellSize::kEighth, x, y, z);
    CellSights sights;
    view_.Classify(blocks, sights);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::size_t cell = CellIn(eighth, i);
      if (sights[i] == CellSight::kFree) {
        seen_.full |= std::uint64_t{1} << cell;
      } else if (sights[i] == CellSight::kMixed && !IsKnown(std::uint64_t{1} << cell)) {
        LookAtBlock(cell, blocks.x[i], blocks.y[i], blocks.z[i]);
      }
    }
  }

  void LookAtBlock(std::size_t cell, float x, float y, float z) {
    const CellBatch octants = ChildrenOf(CellSize::kBlock, x, y, z);
    CellSights sights;
    view_.Classify(octants, sights);
    FreeMask& mask = seen_.masks[cell];
    mask.fill(0);
    const FreeMask before = known_ != nullptr ? known_->MaskOf(static_cast<int>(cell)) : FreeMask{};
    bool is_any = false;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (sights[i] == CellSight::kHidden) continue;
      std::uint64_t layers[kOctantSide];
      if (sights[i] == CellSight::kFree) {
        std::fill_n(layers, kOctantSide, kOctantLayer);
      } else if (!IsKnownOctant(before, i)) {
        TestVoxels(octants.x[i], octants.y[i], octants.z[i], layers);
      } else {
        continue;
      }
      const unsigned shift = ((i & 1) != 0 ? 4u : 0u) + ((i & 2) != 0 ? 32u : 0u);
      const std::size_t first_layer = (i & 4) != 0 ? 4 : 0;
      for (std::size_t z_in = 0; z_in < kOctantSide; ++z_in) {
        mask[first_layer + z_in] |= layers[z_in] << shift;
        is_any = is_any || layers[z_in] != 0;
      }
    }
    if (is_any) seen_.mixed |= std::uint64_t{1} << cell;
  }

  /// Four rows of four voxels, in a layer of a mask.
  static constexpr std::uint64_t kOctantLayer = 0x0F0F0F0F;

  [[nodiscard]] bool IsKnownOctant(const FreeMask& before, std::size_t octant) const {
    if (known_ == nullptr || (confirms_ && seen_.empty())) return false;
    const std::uint64_t layer = kOctantLayer << ((octant & 1) != 0 ? 4 : 0) << ((octant & 2) != 0 ? 32 : 0);
    const std::size_t first = (octant & 4) != 0 ? 4 : 0;
    return std::all_of(before.begin() + first, before.begin() + first + kOctantSide,
                       [layer](std::uint64_t word) { return (word & layer) == layer; });
  }

  void TestVoxels(float x, float y, float z, std::uint64_t (&layers)[kOctantSide]) const {
    constexpr float kToFirst = -HalfSpanOf(CellSize::kOctant);
    alignas(64) std::array<std::uint8_t, kOctantVoxels> is_free;
    view_.Test(x + kToFirst, y + kToFirst, z + kToFirst, is_free);
    for (std::size_t z_in = 0; z_in < kOctantSide; ++z_in) {
      layers[z_in] = TwoRows(is_free.data() + 16 * z_in) | TwoRows(is_free.data() + 16 * z_in + 8) << 16;
    }
  }

  /// Packs two rows of four bytes of 0 or 1 into four bits each, one byte per row.
  static std::uint64_t TwoRows(const std::uint8_t* is_free) {
    std::uint64_t bytes;
    std::memcpy(&bytes, is_free, sizeof(bytes));
    const std::uint64_t bits = bytes * 0x0102040810204080 >> 56;
    return (bits & 0x0F) | (bits & 0xF0) << 4;
  }

  const View& view_;
  const FreeTile* known_;
  bool confirms_;
  FreeBlocks& seen_;
};

}  // namespace dhpmap
