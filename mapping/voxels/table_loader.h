// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>

#include "mapping/voxels/block_entry.h"

namespace dhpmap {

class BlockTable;
class TileMarkTable;

/// Marks of tiles that are not read yet; available once they are. Thread-safe.
class MarkLoader {
 public:
  virtual ~MarkLoader() = default;
  /// Reads the list of tiles if necessary; their names then differ from later ones. Empty if reading fails.
  [[nodiscard]] virtual const TileMarkTable& Read() const = 0;
  /// Null until the tiles are read.
  [[nodiscard]] virtual const TileMarkTable* IfRead() const = 0;
};

/// Loads the tiles of a submap when more than a few of their blocks are requested; a BlockTable holds it in place of
/// its own tiles. Shared by all states with the submap as loaded. Thread-safe.
class TableLoader {
 public:
  virtual ~TableLoader() = default;

  /// Null if the block is not there. Valid as long as this. Throws StatusError.
  [[nodiscard]] virtual const BlockEntry* Find(BlockIndex index) const = 0;
  /// All tiles; read once. Throws StatusError; the next call tries again.
  [[nodiscard]] virtual const BlockTable& Read() const = 0;
  /// Null until all tiles are read.
  [[nodiscard]] const BlockTable* IfRead() const { return all_.load(std::memory_order_acquire); }

  /// Whether blocks of individually read tiles are in memory.
  [[nodiscard]] virtual bool HoldsBlocks() const = 0;
  /// Never null; they outlive this.
  [[nodiscard]] virtual const std::shared_ptr<const MarkLoader>& marks() const = 0;

 protected:
  /// Call once all tiles are read; `all` must outlive this.
  void SetTable(const BlockTable& all) const { all_.store(&all, std::memory_order_release); }

 private:
  mutable std::atomic<const BlockTable*> all_ = nullptr;
};

}  // namespace dhpmap
