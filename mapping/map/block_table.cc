// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/block_table.h"

#include <algorithm>
#include <utility>

namespace dhpmap {

std::size_t BlockTable::SlotOf(BlockIndex index) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = BlockIndexHash{}(index)&mask;
  while (slots_[slot] != kFree && entries_[slots_[slot]].index != index) slot = (slot + 1) & mask;
  return slot;
}

const BlockEntry* BlockTable::Find(BlockIndex index) const {
  if (slots_.empty()) return nullptr;
  const std::uint32_t entry = slots_[SlotOf(index)];
  return entry == kFree ? nullptr : &entries_[entry];
}

BlockEntry* BlockTable::Find(BlockIndex index) { return const_cast<BlockEntry*>(std::as_const(*this).Find(index)); }

BlockEntry& BlockTable::FindOrInsert(BlockIndex index) {
  if (2 * (entries_.size() + 1) > slots_.size()) Rehash(std::max<std::size_t>(16, slots_.size() * 2));
  const std::size_t slot = SlotOf(index);
  if (slots_[slot] == kFree) {
    slots_[slot] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({.index = index, .tsdf = nullptr, .labels = nullptr});
  }
  return entries_[slots_[slot]];
}

bool BlockTable::Erase(BlockIndex index) {
  if (slots_.empty()) return false;
  std::size_t hole = SlotOf(index);
  if (slots_[hole] == kFree) return false;

  const std::uint32_t erased = slots_[hole];
  const auto last = static_cast<std::uint32_t>(entries_.size() - 1);
  if (erased != last) {
    slots_[SlotOf(entries_[last].index)] = erased;
    entries_[erased] = std::move(entries_[last]);
  }
  entries_.pop_back();

  // Close the probe sequence: move back every later entry of the run that may sit in the hole.
  const std::size_t mask = slots_.size() - 1;
  slots_[hole] = kFree;
  for (std::size_t slot = (hole + 1) & mask; slots_[slot] != kFree; slot = (slot + 1) & mask) {
    const std::size_t home = BlockIndexHash{}(entries_[slots_[slot]].index) & mask;
    if (((slot - home) & mask) >= ((slot - hole) & mask)) {
      slots_[hole] = std::exchange(slots_[slot], kFree);
      hole = slot;
    }
  }
  return true;
}

std::size_t BlockTable::MemoryBytes() const {
  std::size_t bytes = entries_.capacity() * sizeof(BlockEntry) + slots_.capacity() * sizeof(std::uint32_t);
  for (const BlockEntry& entry : entries_) {
    if (entry.tsdf) bytes += sizeof(TsdfBlock);
    if (entry.labels) bytes += entry.labels->MemoryBytes();
  }
  return bytes;
}

void BlockTable::Rehash(std::size_t num_slots) {
  slots_.assign(num_slots, kFree);
  for (std::uint32_t i = 0; i < entries_.size(); ++i) slots_[SlotOf(entries_[i].index)] = i;
}

}  // namespace dhpmap
