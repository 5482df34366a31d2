// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/tile_marks.h"

#include <bit>
#include <utility>

#include "mapping/voxels/part_identity.h"

namespace dhpmap {
namespace {

/// The cells of blocks.
template <typename Blocks>
std::uint64_t CellsOf(const Blocks& blocks) {
  std::uint64_t cells = 0;
  for (const auto& block : blocks) cells |= std::uint64_t{1} << CellOf(block.index);
  return cells;
}

/// Calls visit(layer number, cell, name) for each layer that blocks have. Each is a BlockEntry or a BlockMark.
template <typename Blocks, typename Visitor>
void VisitNames(const Blocks& blocks, Visitor&& visit) {
  for (const auto& block : blocks) {
    const int cell = CellOf(block.index);
    ForEachLayer(
        [&](BlockLayer layer, const auto& part) {
          if (WasThere(part)) visit(static_cast<std::size_t>(layer), cell, PartIdOf(part));
        },
        block);
  }
}

/// The names of the blocks' layers, and which layers exist.
template <typename Blocks>
PartNames NamesOf(const Blocks& blocks, std::uint64_t tile, LayerCells& cells) {
  VisitNames(blocks, [&](std::size_t layer, int cell, std::uint64_t) { cells[layer] |= std::uint64_t{1} << cell; });
  std::array<std::size_t, kNumBlockLayers> next{};
  std::size_t num_names = 0;
  for (std::size_t layer = 0; layer < kNumBlockLayers; ++layer) {
    next[layer] = num_names;
    num_names += static_cast<std::size_t>(std::popcount(cells[layer]));
  }
  std::vector<std::uint64_t> names(num_names);
  VisitNames(blocks, [&](std::size_t layer, int, std::uint64_t name) { names[next[layer]++] = name; });
  return {std::move(names), tile};
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
  if (const TileLoader* loader = entry.tile->loader().get()) {
    cells_ = loader->tile().cells;
    names_ = loader->names();
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
