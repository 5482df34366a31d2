// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "mapping/voxels/block_entry.h"
#include "mapping/voxels/part_id.h"

namespace dhpmap {

/// Which blocks of a tile have which layers: bit c of a layer is the block at cell c.
using LayerCells = std::array<std::uint64_t, kNumBlockLayers>;

/// Of all layers together.
inline std::uint64_t AnyOf(const LayerCells& cells) {
  std::uint64_t any = 0;
  for (const std::uint64_t of_layer : cells) any |= of_layer;
  return any;
}

/// Names (PartId) of the layers of a tile's blocks, and of the tile. Immutable, thread-safe.
class PartNames {
 public:
  /// Names of nothing.
  PartNames() = default;
  /// New names, for a tile that was never in memory.
  static PartNames Draw() {
    PartNames names;
    names.first_ = PartId::Reserve(kNumBlockLayers * kTileBlocks + 1);
    names.tile_ = names.first_ + kNumBlockLayers * kTileBlocks;
    return names;
  }
  /// Existing names. `parts`: each layer in turn, by ascending cell.
  PartNames(std::vector<std::uint64_t> parts, std::uint64_t tile) : tile_(tile), parts_(std::move(parts)) {}

  [[nodiscard]] std::uint64_t tile() const { return tile_; }
  /// Name of a block's layer; 0 if it has none.
  [[nodiscard]] std::uint64_t Of(const LayerCells& cells, BlockLayer layer, int cell) const {
    const auto l = static_cast<std::size_t>(layer);
    if ((cells[l] >> cell & 1u) == 0) return 0;
    if (AreDrawn()) return first_ + l * kTileBlocks + static_cast<std::uint64_t>(cell);
    std::size_t position = 0;
    for (std::size_t before = 0; before < l; ++before)
      position += static_cast<std::size_t>(std::popcount(cells[before]));
    const std::uint64_t below = (std::uint64_t{1} << cell) - 1;
    return parts_[position + static_cast<std::size_t>(std::popcount(cells[l] & below))];
  }
  [[nodiscard]] bool AreDrawn() const { return first_ != 0; }

  /// In addition to this object.
  [[nodiscard]] std::size_t MemoryBytes() const { return parts_.capacity() * sizeof(parts_.front()); }

 private:
  std::uint64_t first_ = 0;  ///< first of one name for each possible layer and cell; 0: names are in parts_
  std::uint64_t tile_ = 0;
  std::vector<std::uint64_t> parts_;
};

}  // namespace dhpmap
