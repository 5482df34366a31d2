// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/free/free_space.h"

#include <cassert>
#include <utility>

namespace dhpmap {

bool FreeSpace::IsStale(const FreeTile& tile, std::int64_t stamp_ns) {
  // Stamps are a client's: their difference may not fit, that of the same numbers without a sign does.
  return stamp_ns > tile.last_seen_ns() &&
         static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(tile.last_seen_ns()) >=
             static_cast<std::uint64_t>(kStampStep_ns);
}

std::int64_t FreeSpace::NumFreeVoxels() const {
  std::int64_t count = 0;
  for (const FreeTileEntry& entry : tiles_) count += entry.tile->NumFreeVoxels();
  return count;
}

bool FreeSpace::Add(TileIndex index, const FreeBlocks& seen, std::int64_t stamp_ns) {
  if (seen.empty()) return false;
  const std::uint32_t number = numbers_.Find(index);
  if (number == kNone) {
    auto tile = std::make_shared<FreeTile>();
    tile->Add(seen);
    if (tile->empty()) return false;
    tile->set_last_seen_ns(stamp_ns);
    Put(index, std::move(tile));
    tiles_.back().generation = generation_;
    return true;
  }
  FreeTileEntry& entry = tiles_[number];
  const bool is_stale = IsStale(*entry.tile, stamp_ns), is_new = !entry.tile->Holds(seen);
  if (!is_stale && !is_new) return false;
  if (entry.generation != generation_) {
    entry.tile = std::make_shared<FreeTile>(*entry.tile);
    entry.generation = generation_;
  }
  auto& tile = const_cast<FreeTile&>(*entry.tile);  // made by this generation: nobody else holds it
  if (is_new) tile.Add(seen);
  if (is_stale) tile.set_last_seen_ns(stamp_ns);
  return true;
}

void FreeSpace::Put(TileIndex index, std::shared_ptr<const FreeTile> tile) {
  assert(tile != nullptr && !tile->empty());
  if (const std::uint32_t number = numbers_.Find(index); number != kNone) {
    tiles_[number] = {index, std::move(tile), 0};
    return;
  }
  numbers_.Reserve(tiles_.size() + 1);
  tiles_.push_back({index, std::move(tile), 0});
  numbers_.Set(index, static_cast<std::uint32_t>(tiles_.size() - 1));
}

bool FreeSpace::Erase(TileIndex index) {
  const std::uint32_t number = numbers_.Find(index);
  if (number == kNone) return false;
  numbers_.Erase(index);
  if (number + 1 != tiles_.size()) {
    tiles_[number] = std::move(tiles_.back());
    numbers_.Set(tiles_[number].index, number);
  }
  tiles_.pop_back();
  return true;
}

void FreeSpace::ShareTiles() {
  for (FreeTileEntry& entry : tiles_) entry.generation = 0;
}

std::size_t FreeSpace::MemoryBytes() const {
  std::size_t bytes = sizeof(*this) + tiles_.capacity() * sizeof(FreeTileEntry) + numbers_.MemoryBytes();
  for (const FreeTileEntry& entry : tiles_) bytes += entry.tile->MemoryBytes();
  return bytes;
}

FreeSpaceChange DiffFreeSpace(const FreeSpace* before, const FreeSpace& after) {
  FreeSpaceChange change;
  if (before == &after) return change;
  for (const FreeTileEntry& entry : after.tiles()) {
    const FreeTileEntry* old = before != nullptr ? before->FindEntry(entry.index) : nullptr;
    if (old == nullptr || old->tile != entry.tile) change.written.push_back(&entry);
  }
  if (before == nullptr) return change;
  for (const FreeTileEntry& old : before->tiles()) {
    if (after.FindEntry(old.index) == nullptr) change.erased.push_back(old.index);
  }
  return change;
}

}  // namespace dhpmap
