// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>

#include "mapping/paging/tile_page.h"
#include "mapping/paging/tile_spill.h"
#include "mapping/voxels/block_tile.h"

namespace dhpmap {

/// Which tiles are left on the disk.
struct EvictionRule {
  bool even_used = false;            ///< what somebody has asked for since the last time, or written to lately
  TileSpill* spill = nullptr;        ///< takes what was written since it was read; null: that stays in memory
  std::uint64_t written_lately = 0;  ///< names of parts (PartId) from about this one on
  /// What was left of tiles that several submaps share, for one pass over all of them; null: of none.
  std::unordered_map<const BlockTile*, std::shared_ptr<const BlockTile>>* left = nullptr;
};

/// Leaves tiles of one table on the disk (BlockTable::Replace): again those that were read from there, and if there is
/// a place for them the others. What the place refuses stays in memory, and so do empty blocks. Thread-compatible.
class TileEvictor {
 public:
  explicit TileEvictor(const EvictionRule& rule) : rule_(rule), spill_(rule.spill) {}

  /// The same tile with its blocks on the disk; null: it stays as it is.
  [[nodiscard]] std::shared_ptr<const BlockTile> operator()(const BlockTile& tile);

 private:
  std::shared_ptr<const BlockTile> Evict(const BlockTile& tile);

  const EvictionRule rule_;
  TileSpill* spill_;  ///< null from then on where it has no room
};

/// The same tile with its blocks where `source` has them just as they are; of one that can be left (CanBeLeft), which
/// nobody writes to.
[[nodiscard]] std::shared_ptr<const BlockTile> LeftAt(const BlockTile& tile, std::shared_ptr<TileSource> source);

}  // namespace dhpmap
