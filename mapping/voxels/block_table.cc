// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/block_table.h"

#include <utility>

#include "mapping/base/status_error.h"

namespace dhpmap {
namespace {

/// Adds the wanted layers of `from`, with their storage keys.
void AddLayersOf(const BlockTile* from, const BlockLayers& wanted, BlockTile& into) {
  if (from == nullptr) return;
  for (const BlockEntry& block : from->entries()) {
    BlockEntry part;
    bool has_any = false;
    ForEachLayer(
        [&](BlockLayer layer, const auto& of, auto& to) {
          if (!wanted[static_cast<std::size_t>(layer)] || of == nullptr) return;
          to = of;
          has_any = true;
        },
        block, part);
    if (!has_any) continue;
    BlockEntry& entry = into.FindOrInsert(block.index);
    ForEachLayer(
        [](BlockLayer, const auto& of, auto& to) {
          if (of != nullptr) to = of;
        },
        part, entry);
  }
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
    const auto layer = static_cast<BlockLayer>(i);
    if (wanted[i]) into.stored(layer).Adopt(from->stored(layer));
  }
}

}  // namespace

BlockTile& BlockTable::Own(TileEntry& entry, std::uint64_t generation) {
  if (entry.generation != generation || entry.is_forked) {
    const bool is_own = entry.generation == generation;
    auto copy = std::make_shared<BlockTile>(*entry.tile);
    for (BlockEntry& block : copy->mutable_entries()) {
      block.owned_tsdf = is_own && (block.owns_tsdf || block.owned_tsdf);
      block.owned_labels = is_own && (block.owns_labels || block.owned_labels);
      block.owns_tsdf = block.owns_labels = block.owns_gone = false;
    }
    entry.tile = std::move(copy);
    entry.generation = generation;
    entry.is_forked = false;
  }
  return const_cast<BlockTile&>(*entry.tile);  // made by this generation: not shared
}

const BlockEntry* BlockTable::FindElsewhere(BlockIndex index) const {
  if (unread_ == nullptr) return nullptr;
  const BlockTable* all = unread_->IfRead();
  return all != nullptr ? all->Find(index) : unread_->Find(index);
}

std::span<const TileEntry> BlockTable::tiles_if_read() const {
  if (unread_ == nullptr) return tiles_;
  const BlockTable* read = unread_->IfRead();
  return read != nullptr ? read->tiles() : std::span<const TileEntry>();
}

void BlockTable::TakeTiles() {
  const BlockTable& read = ReadTiles();
  tiles_ = read.tiles_;
  numbers_ = read.numbers_;
  num_blocks_ = read.num_blocks_;
  unread_ = nullptr;
}

BlockTable::OwnEntry BlockTable::FindOwn(BlockIndex index, std::uint64_t generation) {
  BeginWriting();
  const std::uint32_t number = numbers_.Find(TileOf(index));
  if (number == kNone || tiles_[number].generation != generation) return {};
  auto& tile = const_cast<BlockTile&>(*tiles_[number].tile);  // made by this generation: no snapshot holds it
  (void)tile.mutable_entries();                               // drops cached values
  return {tile.Find(CellOf(index)), tiles_[number].is_forked};
}

BlockEntry& BlockTable::FindOrInsert(BlockIndex index, std::uint64_t generation) {
  BeginWriting();
  const TileIndex tile_index = TileOf(index);
  std::uint32_t number = numbers_.Find(tile_index);
  if (number == kNone) {
    number = static_cast<std::uint32_t>(tiles_.size());
    tiles_.push_back({tile_index, std::make_shared<BlockTile>(), generation});
    numbers_.Set(tile_index, number);
  }
  BlockTile& tile = Own(tiles_[number], generation);
  const std::size_t num_before = tile.entries().size();
  BlockEntry& entry = tile.FindOrInsert(index);
  num_blocks_ += tile.entries().size() - num_before;
  return entry;
}

void BlockTable::PutTile(TileIndex index, std::shared_ptr<const BlockTile> tile) {
  constexpr std::uint64_t kOlderThanAnyWriter = 0;
  BeginWriting();
  num_blocks_ += tile->size();
  numbers_.Set(index, static_cast<std::uint32_t>(tiles_.size()));
  tiles_.push_back({index, std::move(tile), kOlderThanAnyWriter});
}

bool BlockTable::Erase(BlockIndex index, std::uint64_t generation) {
  if (Find(index) == nullptr) return false;
  BeginWriting();
  const TileIndex tile_index = TileOf(index);
  const std::uint32_t number = numbers_.Find(tile_index);
  BlockTile& tile = Own(tiles_[number], generation);
  tile.Erase(CellOf(index));
  --num_blocks_;
  if (tile.empty()) EraseTile(number);
  return true;
}

void BlockTable::EraseTile(std::uint32_t number) {
  numbers_.Erase(tiles_[number].index);
  if (number + 1 != tiles_.size()) {
    tiles_[number] = std::move(tiles_.back());
    numbers_.Set(tiles_[number].index, number);
  }
  tiles_.pop_back();
}

void BlockTable::PutLayers(TileIndex index, const BlockTile* from, const BlockLayers& layers) {
  constexpr std::uint64_t kOlderThanAnyWriter = 0;
  BeginWriting();
  const std::uint32_t number = numbers_.Find(index);
  BlockLayers others{};
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) others[i] = !layers[i];
  auto tile = std::make_shared<BlockTile>();
  AddLayersOf(number == kNone ? nullptr : tiles_[number].tile.get(), others, *tile);
  AddLayersOf(from, layers, *tile);
  if (number != kNone) num_blocks_ -= tiles_[number].tile->size();
  if (tile->empty()) {
    if (number != kNone) EraseTile(number);
  } else if (number == kNone) {
    PutTile(index, std::move(tile));
  } else {
    num_blocks_ += tile->entries().size();
    tiles_[number] = {index, std::move(tile), kOlderThanAnyWriter};
  }
}

/// Takes over all tiles if the loader has read some blocks by themselves, by reading the rest.
bool BlockTable::TakeTilesInMemory() {
  if (unread_->IfRead() == nullptr && !unread_->HoldsBlocks()) return false;
  try {
    TakeTiles();
    return true;
  } catch (const StatusError&) {
    return false;  // the blocks stay; a later request returns the error
  }
}

bool BlockTable::Replace(const OtherTile& other) {
  if (unread_ != nullptr && !TakeTilesInMemory()) return false;
  bool has_any = false;
  for (TileEntry& entry : tiles_) {
    auto same = other(*entry.tile);
    if (same == nullptr) continue;
    entry.tile = std::move(same);
    has_any = true;
  }
  return has_any;
}

void BlockTable::ShareTiles() {
  for (TileEntry& entry : tiles_) entry.generation = 0;
}

void BlockTable::ForkTiles() {
  for (TileEntry& entry : tiles_) entry.is_forked = true;
}

std::size_t BlockTable::MemoryBytes() const {
  if (unread_ != nullptr) return unread_->IfRead() != nullptr ? unread_->Read().MemoryBytes() : 0;
  std::size_t bytes = tiles_.capacity() * sizeof(TileEntry) + numbers_.MemoryBytes();
  for (const TileEntry& entry : tiles_) bytes += entry.tile->MemoryBytes();
  return bytes;
}

}  // namespace dhpmap
