// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/block_tile.h"

#include <utility>

#include "mapping/map/scanned_tile.h"

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
  if (page_ == nullptr || labels.IsShort()) labels_.Keep(std::move(labels));
}

void BlockTile::KeepShortLabelsOf(const BlockTile& other) {
  const TileLabels* known = other.labels_.Find();
  if (known != nullptr && known->IsShort()) labels_.Keep(*known);
}

bool BlockTile::CanBeUnread() const {
  if (page_ == nullptr || !page_->IsRead()) return false;
  if (page_->HasOwnNames()) return true;  // wherever else it is stored
  const TileOnDisk& there = page_->tile();
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
    if (there.keys[i] != 0 && stored_[i].In(there.store) != there.keys[i]) return false;  // stored anew since
  }
  return true;
}

std::shared_ptr<const BlockTile> BlockTile::Unread() const {
  auto unread = std::make_shared<BlockTile>(page_->LetGo());
  if (const auto known = KnownExtent()) unread->extent_.Keep(*known);
  unread->KeepShortLabelsOf(*this);
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) unread->stored_[i].Adopt(stored_[i]);
  return unread;
}

bool BlockTile::CanBeLeft() const {
  if (page_ != nullptr || empty()) return false;
  std::uint64_t cells = 0;
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) cells |= CellsWith(static_cast<BlockLayer>(i));
  return cells == cells_;
}

std::shared_ptr<const BlockTile> BlockTile::LeftAt(std::shared_ptr<TileSource> source) const {
  TileOnDisk there{.index = TileOf(entries_.front().index), .extent = extent_.code()};
  std::vector<std::uint64_t> names;
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
    for (const BlockEntry& entry : entries_) {
      ForEachLayer(
          [&](BlockLayer layer, const auto& part) {
            if (static_cast<std::size_t>(layer) != i || part == nullptr) return;
            there.cells[i] |= std::uint64_t{1} << CellOf(entry.index);
            names.push_back(part->part_id.value());
          },
          entry);
    }
  }
  PartNames named(std::move(names), part_id_.value());
  auto left = std::make_shared<BlockTile>(std::make_shared<const TilePage>(there, std::move(source), std::move(named)));
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) left->stored_[i].Adopt(stored_[i]);
  left->KeepShortLabelsOf(*this);
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
