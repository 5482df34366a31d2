// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/map/label_block.h"
#include "mapping/map/tsdf_block.h"

namespace dhpmap {

/// One block of a submap: its two layers, shared with every snapshot that holds the same state. `labels` is null where
/// nothing was ever labelled (the unknown submap, dropped labels).
struct BlockEntry {
  BlockIndex index;
  std::shared_ptr<const TsdfBlock> tsdf;
  std::shared_ptr<const LabelBlock> labels;
  /// Writer's generation in which each layer was made: equal to the current one, the writer alone owns it.
  std::uint64_t tsdf_generation = 0;
  std::uint64_t labels_generation = 0;
};

/// Hash table from block index to block, with entries kept in one array in the order of their allocation. Copying it
/// shares the blocks. Thread-compatible.
class BlockTable {
 public:
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  /// Order of allocation; erasing moves the last entry into the gap.
  [[nodiscard]] std::span<const BlockEntry> entries() const { return entries_; }
  /// The caller leaves every index as it is.
  [[nodiscard]] std::span<BlockEntry> mutable_entries() { return entries_; }

  /// Null if the block is not there. Valid until the table is next modified.
  [[nodiscard]] const BlockEntry* Find(BlockIndex index) const;
  [[nodiscard]] BlockEntry* Find(BlockIndex index);

  /// Finds the entry or appends one without layers. May invalidate pointers to entries.
  BlockEntry& FindOrInsert(BlockIndex index);
  bool Erase(BlockIndex index);

  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFu;

  /// The slot that holds `index`, or the free slot where it would go. Requires a non-empty slot array.
  [[nodiscard]] std::size_t SlotOf(BlockIndex index) const;
  void Rehash(std::size_t num_slots);

  std::vector<BlockEntry> entries_;
  std::vector<std::uint32_t> slots_;  // open addressing, linear probing, power of two, at most half full
};

}  // namespace dhpmap
