// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>

#include "mapping/voxels/block_entry.h"

namespace dhpmap {

class BlockTable;
class TileMarkTable;

/// Marks of tiles that nobody has asked for: there are some once somebody has. Thread-safe.
class MarkLoader {
 public:
  virtual ~MarkLoader() = default;
  /// Reads which tiles there are if nobody has; their names then are others than they will be. Empty where they cannot
  /// be read.
  [[nodiscard]] virtual const TileMarkTable& Read() const = 0;
  /// Null if nobody has read the tiles.
  [[nodiscard]] virtual const TileMarkTable* IfRead() const = 0;
};

/// The tiles of a submap, which are read when somebody asks for more than a few of their blocks: what a BlockTable has
/// in place of its own. Shared by all states that have the submap as it was loaded. Thread-safe.
class TableLoader {
 public:
  virtual ~TableLoader() = default;

  /// Null if the block is not there. Valid as long as this. Throws StatusError.
  [[nodiscard]] virtual const BlockEntry* Find(BlockIndex index) const = 0;
  /// All of them, once and for all. Throws StatusError; the next call tries again.
  [[nodiscard]] virtual const BlockTable& Read() const = 0;
  /// Null if nobody has read all of them.
  [[nodiscard]] const BlockTable* IfRead() const { return all_.load(std::memory_order_acquire); }

  /// Whether blocks of tiles that were read one by one are in memory.
  [[nodiscard]] virtual bool HoldsBlocks() const = 0;
  /// Never null; they outlive this.
  [[nodiscard]] virtual const std::shared_ptr<const MarkLoader>& marks() const = 0;

 protected:
  /// To be called once all are read; `all` lives as long as this.
  void SetTable(const BlockTable& all) const { all_.store(&all, std::memory_order_release); }

 private:
  mutable std::atomic<const BlockTable*> all_ = nullptr;
};

}  // namespace dhpmap
