// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/grid.h"

namespace dhpmap {

/// Hash table from a grid index (BlockIndex, TileIndex) to a number, such as its position in an array: open addressing,
/// linear probing, at most half full. Thread-compatible.
template <typename Index>
class IndexMap {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  [[nodiscard]] std::size_t size() const { return size_; }

  /// kNone if it is not there.
  [[nodiscard]] std::uint32_t Find(Index index) const { return slots_.empty() ? kNone : slots_[SlotOf(index)].number; }

  /// Adds or replaces; `number` is not kNone.
  void Set(Index index, std::uint32_t number) {
    assert(number != kNone);
    Reserve(size_ + 1);
    Slot& slot = slots_[SlotOf(index)];
    size_ += slot.number == kNone ? 1 : 0;
    slot = {index, number};
  }

  /// Returns whether it was there.
  bool Erase(Index index) {
    if (Find(index) == kNone) return false;
    // Closes the probe sequence: moves later slots of the run into the hole if they may be there.
    const std::size_t mask = slots_.size() - 1;
    std::size_t hole = SlotOf(index);
    slots_[hole].number = kNone;
    for (std::size_t slot = (hole + 1) & mask; slots_[slot].number != kNone; slot = (slot + 1) & mask) {
      const std::size_t home = HashOf(slots_[slot].index) & mask;
      if (((slot - home) & mask) < ((slot - hole) & mask)) continue;
      slots_[hole] = slots_[slot];
      slots_[slot].number = kNone;
      hole = slot;
    }
    --size_;
    return true;
  }

  /// Room for `count` indices without growing again.
  void Reserve(std::size_t count) {
    if (2 * count <= slots_.size()) return;
    std::vector<Slot> old(std::bit_ceil(std::max<std::size_t>(8, 2 * count)));
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number != kNone) slots_[SlotOf(slot.index)] = slot;
    }
  }

  [[nodiscard]] std::size_t MemoryBytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    Index index{};
    std::uint32_t number = kNone;
  };

  static std::size_t HashOf(Index index) { return BlockIndexHash{}(BlockIndex{index.x, index.y, index.z}); }

  /// The slot that holds `index`, or the free slot for it.
  [[nodiscard]] std::size_t SlotOf(Index index) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = HashOf(index) & mask;
    while (slots_[slot].number != kNone && slots_[slot].index != index) slot = (slot + 1) & mask;
    return slot;
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};

}  // namespace dhpmap
