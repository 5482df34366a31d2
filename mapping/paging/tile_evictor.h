// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>

#include "mapping/paging/tile_page.h"
#include "mapping/paging/tile_spill.h"
#include "mapping/voxels/block_tile.h"

namespace dhpmap {

/// Which tiles to evict.
struct EvictionRule {
  bool even_used = false;            ///< also tiles that were used since the last pass or written lately
  TileSpill* spill = nullptr;        ///< takes tiles that were written since they were read; null: those stay in memory
  std::uint64_t written_lately = 0;  ///< part names (PartId) from about this one on are recent
  /// Evicted counterparts of tiles that several submaps share, for one pass over all of them; null for tiles that stay.
  std::unordered_map<const BlockTile*, std::shared_ptr<const BlockTile>>* left = nullptr;
};

/// Evicts tiles of one table (BlockTable::Replace): those that were read from disk and, given a spill, the others.
/// Tiles that the spill refuses stay in memory, and so do empty blocks. Thread-compatible.
class TileEvictor {
 public:
  explicit TileEvictor(const EvictionRule& rule) : rule_(rule), spill_(rule.spill) {}

  /// The same tile, evicted; null: it stays in memory.
  [[nodiscard]] std::shared_ptr<const BlockTile> operator()(const BlockTile& tile);

 private:
  std::shared_ptr<const BlockTile> Evict(const BlockTile& tile);

  const EvictionRule rule_;
  TileSpill* spill_;  ///< set to null when it is full
};

/// The same tile, backed by `source`, which has identical blocks. The tile must be evictable (CanBeLeft) and have no
/// writer.
[[nodiscard]] std::shared_ptr<const BlockTile> LeftAt(const BlockTile& tile, std::shared_ptr<TileSource> source);

}  // namespace dhpmap
