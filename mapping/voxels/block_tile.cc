// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/block_tile.h"

#include <utility>

#include "mapping/base/status_error.h"

namespace dhpmap {

BlockTile::BlockTile(const BlockTile& other)
    : cells_(other.cells_), entries_(other.entries().begin(), other.entries().end()) {}

TileExtent BlockTile::Extent() const {
  if (const auto known = KnownExtent()) return *known;
  const TileExtent extent = ExtentOf(ScannedTile(*this).entries());
  extent_.Keep(extent);
  return extent;
}

void BlockTile::AddLabelsTo(LabelTotals& totals) const {
  if (const TileLabels* known = labels_.Find()) return known->AddTo(totals);
  TileLabels labels = LabelsOf(ScannedTile(*this).entries());
  labels.AddTo(totals);
  if (loader_ == nullptr || labels.IsShort()) labels_.Keep(std::move(labels));
}

void BlockTile::KeepShortLabelsOf(const BlockTile& other) {
  const TileLabels* known = other.labels_.Find();
  if (known != nullptr && known->IsShort()) labels_.Keep(*known);
}

bool BlockTile::CanBeUnread() const {
  if (loader_ == nullptr || !loader_->IsRead()) return false;
  if (loader_->HasOwnNames()) return true;  // spilled: its loader can always read it again
  const TileOnDisk& there = loader_->tile();
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
    if (there.keys[i] != 0 && stored_[i].In(there.store) != there.keys[i]) return false;  // stored again since
  }
  return true;
}

bool BlockTile::CanBeLeft() const {
  if (loader_ != nullptr || empty()) return false;
  std::uint64_t cells = 0;
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) cells |= CellsWith(static_cast<BlockLayer>(i));
  return cells == cells_;
}

std::shared_ptr<const BlockTile> BlockTile::LeftTo(std::shared_ptr<const TileLoader> loader) const {
  auto left = std::make_shared<BlockTile>(std::move(loader));
  if (const auto known = KnownExtent()) left->extent_.Keep(*known);
  left->KeepShortLabelsOf(*this);
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) left->stored_[i].Adopt(stored_[i]);
  return left;
}

BlockEntry& BlockTile::FindOrInsert(BlockIndex index) {
  ForgetWhatWasFound();
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
  ForgetWhatWasFound();
  entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(PositionOf(cell)));
  cells_ &= ~bit;
  return true;
}

std::uint64_t BlockTile::CellsWith(BlockLayer layer) const {
  if (loader_ != nullptr) return loader_->tile().cells[static_cast<std::size_t>(layer)];
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
  if (loader_ != nullptr) return bytes + loader_->OwnBytes() + loader_->BlockBytes();
  for (const BlockEntry& entry : entries_) {
    if (entry.tsdf) bytes += entry.tsdf->MemoryBytes();
    if (entry.labels) bytes += entry.labels->MemoryBytes();
    if (entry.gone) bytes += entry.gone->MemoryBytes();
  }
  return bytes;
}

std::span<const BlockEntry> ScannedTile::Read(const BlockTile& tile) {
  if (tile.IsRead()) return tile.entries();
  try {
    own_ = tile.loader()->ReadInPassing();
    return own_->blocks();
  } catch (const StatusError&) {
    return tile.entries();  // of an older state: a writer reads a tile before its blobs are deleted
  }
}

}  // namespace dhpmap
