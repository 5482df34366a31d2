// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/tile_directory.h"

#include <algorithm>
#include <utility>

#include "mapping/base/status_error.h"

namespace dhpmap {
namespace {

// A tile that is read by itself takes some 10 us, and a look at those that were some 30 ns.
constexpr std::size_t kMostReadOneByOne = 64;
constexpr int kMostLookups = 4096;

template <typename Value>
Value OrThrow(Result<Value> result) {
  if (!result.ok()) throw StatusError(result.status());
  return std::move(result).value();
}

}  // namespace

const TileMarkTable& UnreadMarks::Read() const {
  if (const TileMarkTable* table = IfRead()) return *table;
  const MutexLock lock(mutex_);
  if (is_read_.load(std::memory_order_relaxed)) return table_;
  const auto read = directory_->ReadAll();
  static const TileMarkTable nothing;
  if (!read.ok()) return nothing;
  std::vector<TileEntry> tiles;
  tiles.reserve(read->size());
  for (const TileDirectory::Tile& tile : *read) tiles.push_back({tile.index, tile.tile});
  FillNow(tiles);
  return table_;
}

void UnreadMarks::Fill(std::span<const TileEntry> tiles) const {
  const MutexLock lock(mutex_);
  if (!is_read_.load(std::memory_order_relaxed)) FillNow(tiles);
}

void UnreadMarks::FillNow(std::span<const TileEntry> tiles) const {
  table_.Reserve(tiles.size());
  for (const TileEntry& tile : tiles) table_.Add(std::make_shared<const TileMarks>(tile));
  is_read_.store(true, std::memory_order_release);
}

const BlockEntry* UnreadTiles::Find(BlockIndex index) const {
  const BlockTable* all = IfRead();
  const BlockTile* one = nullptr;
  if (all == nullptr) {
    const MutexLock lock(mutex_);
    const bool are_enough = ++num_lookups_ > kMostLookups || some_.size() == kMostReadOneByOne || directory_->HasFew();
    if (are_enough || table_ != nullptr) all = &ReadNow();
    else one = ReadOne(TileOf(index));
  }
  if (all != nullptr) return all->Find(index);
  return one != nullptr ? one->Find(CellOf(index)) : nullptr;  // not under the mutex: it may have to be read
}

const BlockTable& UnreadTiles::Read() const {
  if (const BlockTable* all = IfRead()) return *all;
  const MutexLock lock(mutex_);
  return ReadNow();
}

bool UnreadTiles::HoldsBlocks() const {
  const MutexLock lock(mutex_);
  return std::any_of(some_.begin(), some_.end(),
                     [](const auto& one) { return one.tile != nullptr && one.tile->IsRead(); });
}

const BlockTable& UnreadTiles::ReadNow() const {
  if (table_ != nullptr) return *table_;
  auto table = std::make_unique<BlockTable>();
  IndexMap<TileIndex> known;  // position in some_
  for (std::uint32_t i = 0; i < some_.size(); ++i) {
    if (some_[i].tile != nullptr) known.Set(some_[i].index, i);
  }
  for (TileDirectory::Tile& read : OrThrow(directory_->ReadAll())) {
    const std::uint32_t i = known.Find(read.index);
    table->PutTile(read.index, i != IndexMap<TileIndex>::kNone ? some_[i].tile : std::move(read.tile));
  }
  own_marks_->Fill(table->tiles());
  table_ = std::move(table);
  SetTable(*table_);
  return *table_;
}

const BlockTile* UnreadTiles::ReadOne(TileIndex index) const {
  const auto known = std::find_if(some_.begin(), some_.end(), [index](const auto& one) { return one.index == index; });
  if (known != some_.end()) return known->tile.get();
  auto tile = OrThrow(directory_->ReadOne(index));
  return some_.emplace_back(TileDirectory::Tile{index, std::move(tile)}).tile.get();
}

}  // namespace dhpmap
