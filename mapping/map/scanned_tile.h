// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "mapping/base/status_error.h"
#include "mapping/map/block_tile.h"
#include "mapping/map/page_reader.h"

namespace dhpmap {

/// The blocks of a tile for who goes through a whole map once: what it reads from the disk goes with it, and what
/// others have read stays. Blocks that are to last longer are copied (BlockEntry). Thread-compatible.
class ScannedTile {
 public:
  /// `tile` lives longer. Throws StatusError.
  explicit ScannedTile(const BlockTile& tile) : entries_(Read(tile)) {}
  ScannedTile(const ScannedTile&) = delete;
  ScannedTile& operator=(const ScannedTile&) = delete;

  /// By ascending cell.
  [[nodiscard]] std::span<const BlockEntry> entries() const { return entries_; }

 private:
  std::span<const BlockEntry> Read(const BlockTile& tile) {
    if (tile.IsRead()) return tile.entries();
    try {
      const PageReader::Passing passing;
      return own_.emplace(*tile.page()).blocks();
    } catch (const StatusError&) {
      own_.reset();
      return tile.entries();  // of an older state: who changed the tile has read it before its blobs went
    }
  }

  std::optional<TilePage> own_;  ///< before what is in it
  std::span<const BlockEntry> entries_;
};

}  // namespace dhpmap
