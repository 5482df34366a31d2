// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/block_tile.h"

namespace dhpmap {

BlockTile::BlockTile(const BlockTile& other)
    : cells_(other.cells_), entries_(other.entries().begin(), other.entries().end()) {}

bool BlockTile::CanBeUnread() const {
  if (page_ == nullptr || !page_->IsRead()) return false;
  const TileOnDisk& there = page_->tile();
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
    if (there.keys[i] != 0 && stored_[i].In(there.store) != there.keys[i]) return false;  // stored anew since
  }
  return true;
}

std::shared_ptr<const BlockTile> BlockTile::Unread() const { return std::make_shared<const BlockTile>(page_->LetGo()); }

BlockEntry& BlockTile::FindOrInsert(BlockIndex index) {
  const int cell = CellOf(index);
  const std::size_t position = PositionOf(cell);
  const std::uint64_t bit = std::uint64_t{1} << cell;
  if ((cells_ & bit) == 0) {
    entries_.insert(entries_.begin() + static_cast<std::ptrdiff_t>(position), BlockEntry{.index = index});
    cells_ |= bit;
  }
  return entries_[position];
}

bool BlockTile::Erase(int cell) {
  const std::uint64_t bit = std::uint64_t{1} << cell;
  if ((cells_ & bit) == 0) return false;
  entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(PositionOf(cell)));
  cells_ &= ~bit;
  return true;
}

std::uint64_t BlockTile::CellsWith(BlockLayer layer) const {
  if (page_ != nullptr) return page_->tile().cells[static_cast<std::size_t>(layer)];
  std::uint64_t cells = 0;
  for (const BlockEntry& entry : entries_) {
    ForEachLayer(
        [&](BlockLayer of, const auto& part) {
          if (of == layer && part != nullptr) cells |= std::uint64_t{1} << CellOf(entry.index);
        },
        entry);
  }
  return cells;
}

std::size_t BlockTile::MemoryBytes() const {
  std::size_t bytes = sizeof(*this) + entries_.capacity() * sizeof(BlockEntry);
  if (page_ != nullptr) return bytes + sizeof(*page_) + page_->BlockBytes();
  for (const BlockEntry& entry : entries_) {
    if (entry.tsdf) bytes += entry.tsdf->MemoryBytes();
    if (entry.labels) bytes += entry.labels->MemoryBytes();
    if (entry.gone) bytes += entry.gone->MemoryBytes();
  }
  return bytes;
}

}  // namespace dhpmap
