// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/tile_marks.h"

#include <utility>

#include "mapping/map/diff_submap.h"

namespace dhpmap {
namespace {

/// The cells of blocks.
template <typename Blocks>
std::uint64_t CellsOf(const Blocks& blocks) {
  std::uint64_t cells = 0;
  for (const auto& block : blocks) cells |= std::uint64_t{1} << CellOf(block.index);
  return cells;
}

/// What the layers of blocks are called, and which there are. Each of `blocks` is a BlockEntry or a BlockMark.
template <typename Blocks>
PartNames NamesOf(const Blocks& blocks, std::uint64_t tile, LayerCells& cells) {
  std::array<std::vector<std::uint64_t>, kNumBlockLayers> names;
  for (const auto& block : blocks) {
    ForEachLayer(
        [&](BlockLayer layer, const auto& part) {
          if (!WasThere(part)) return;
          const auto l = static_cast<std::size_t>(layer);
          cells[l] |= std::uint64_t{1} << CellOf(block.index);
          names[l].push_back(PartIdOf(part));
        },
        block);
  }
  std::vector<std::uint64_t> all;
  all.reserve(names[0].size() + names[1].size() + names[2].size());
  for (const auto& of_layer : names) all.insert(all.end(), of_layer.begin(), of_layer.end());
  return {std::move(all), tile};
}

}  // namespace

bool BlockMark::IsOf(const BlockEntry& entry) const {
  bool is_same = true;
  ForEachLayer(
      [&is_same](BlockLayer, const auto& name, const auto& layer) { is_same = is_same && IsSamePart(name, layer); },
      *this, entry);
  return is_same;
}

TileMarks::TileMarks(const TileEntry& entry) : index_(entry.index), blocks_(entry.tile->cells()) {
  if (const TilePage* page = entry.tile->page().get()) {
    cells_ = page->tile().cells;
    names_ = page->names();
  } else {
    names_ = NamesOf(entry.tile->entries(), entry.tile->part_id(), cells_);
  }
}

TileMarks::TileMarks(TileIndex index, std::span<const BlockMark> blocks)
    : index_(index), blocks_(CellsOf(blocks)), names_(NamesOf(blocks, 0, cells_)) {}

BlockMark TileMarks::At(int cell) const {
  BlockMark mark;
  mark.index = BlockIn(index_, cell);
  ForEachLayer([&](BlockLayer layer, auto& name) { name = names_.Of(cells_, layer, cell); }, mark);
  return mark;
}

std::optional<BlockMark> TileMarks::Find(int cell) const {
  if ((cells() >> cell & 1u) == 0) return std::nullopt;
  return At(cell);
}

std::vector<BlockMark> TileMarks::blocks() const {
  std::vector<BlockMark> blocks;
  blocks.reserve(static_cast<std::size_t>(std::popcount(cells())));
  for (std::uint64_t left = cells(); left != 0; left &= left - 1) blocks.push_back(At(std::countr_zero(left)));
  return blocks;
}

void TileMarkTable::Reserve(std::size_t num_tiles) {
  tiles_.reserve(num_tiles);
  numbers_.Reserve(num_tiles);
}

void TileMarkTable::Add(std::shared_ptr<const TileMarks> tile) {
  numbers_.Set(tile->index(), static_cast<std::uint32_t>(tiles_.size()));
  tiles_.push_back(std::move(tile));
}

std::shared_ptr<const TileMarks> TileMarkTable::Find(TileIndex index) const {
  const std::uint32_t number = numbers_.Find(index);
  return number == IndexMap<TileIndex>::kNone ? nullptr : tiles_[number];
}

}  // namespace dhpmap
