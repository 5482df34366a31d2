// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/voxels/block_table.h"
#include "mapping/voxels/part_names.h"

namespace dhpmap {

/// Names of a block's layers, kept after its state is released. Thread-compatible.
struct BlockMark {
  BlockIndex index;
  // See PartId; 0 where there was no layer.
  std::uint64_t tsdf = 0;
  std::uint64_t labels = 0;
  std::uint64_t gone = 0;

  /// Whether they name exactly the layers of `entry`.
  [[nodiscard]] bool IsOf(const BlockEntry& entry) const;
};

/// Names of the parts of a tile, 8 bytes each; only the first name for a tile that was never in memory. Immutable,
/// shared by the marks of all states with the same tile.
class TileMarks {
 public:
  /// Reads nothing from disk.
  explicit TileMarks(const TileEntry& entry);
  /// For blocks that never formed a whole tile object; by ascending cell.
  TileMarks(TileIndex index, std::span<const BlockMark> blocks);

  [[nodiscard]] TileIndex index() const { return index_; }
  /// See PartId; 0 if there was no whole tile object.
  [[nodiscard]] std::uint64_t tile() const { return names_.tile(); }
  [[nodiscard]] bool empty() const { return blocks_ == 0; }
  /// Bit c: there was a block at cell c.
  [[nodiscard]] std::uint64_t cells() const { return blocks_; }
  /// For a cell that had a block.
  [[nodiscard]] BlockMark At(int cell) const;
  /// Nothing if there was no block at this cell.
  [[nodiscard]] std::optional<BlockMark> Find(int cell) const;
  /// By ascending cell.
  [[nodiscard]] std::vector<BlockMark> blocks() const;

  /// Whether they name exactly this tile.
  [[nodiscard]] bool IsOf(const TileEntry& entry) const { return tile() == entry.tile->part_id(); }

 private:
  TileIndex index_;
  std::uint64_t blocks_ = 0;  ///< bit c: there was a block at cell c, with or without layers
  LayerCells cells_{};
  PartNames names_;
};

/// The marks of a submap's tiles. Immutable once all are added, then thread-safe.
class TileMarkTable {
 public:
  void Reserve(std::size_t num_tiles);
  void Add(std::shared_ptr<const TileMarks> tile);
  /// In the order in which they were added.
  [[nodiscard]] std::span<const std::shared_ptr<const TileMarks>> tiles() const { return tiles_; }
  /// Null if the tile was not there.
  [[nodiscard]] std::shared_ptr<const TileMarks> Find(TileIndex index) const;

 private:
  std::vector<std::shared_ptr<const TileMarks>> tiles_;
  IndexMap<TileIndex> numbers_;  ///< position in tiles_
};

}  // namespace dhpmap
