// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/block_tile.h"

namespace dhpmap {

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

std::size_t BlockTile::MemoryBytes() const {
  std::size_t bytes = sizeof(*this) + entries_.capacity() * sizeof(BlockEntry);
  for (const BlockEntry& entry : entries_) {
    if (entry.tsdf) bytes += entry.tsdf->MemoryBytes();
    if (entry.labels) bytes += entry.labels->MemoryBytes();
    if (entry.gone) bytes += entry.gone->MemoryBytes();
  }
  return bytes;
}

}  // namespace dhpmap
