// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/tile_evictor.h"

#include <utility>
#include <vector>

namespace dhpmap {

std::shared_ptr<const BlockTile> LeftAt(const BlockTile& tile, std::shared_ptr<TileSource> source) {
  const auto extent = tile.KnownExtent();
  TileOnDisk there{.index = TileOf(tile.entries().front().index), .extent = extent ? extent->Code() : 0};
  std::vector<std::uint64_t> names;
  for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
    for (const BlockEntry& entry : tile.entries()) {
      ForEachLayer(
          [&](BlockLayer layer, const auto& part) {
            if (static_cast<std::size_t>(layer) != i || part == nullptr) return;
            there.cells[i] |= std::uint64_t{1} << CellOf(entry.index);
            names.push_back(part->part_id.value());
          },
          entry);
    }
  }
  PartNames named(std::move(names), tile.part_id());
  return tile.LeftTo(std::make_shared<const TilePage>(there, std::move(source), std::move(named)));
}

std::shared_ptr<const BlockTile> TileEvictor::operator()(const BlockTile& tile) {
  if (rule_.left != nullptr) {
    if (const auto found = rule_.left->find(&tile); found != rule_.left->end()) return found->second;
  }
  auto left = Evict(tile);
  if (left != nullptr && rule_.left != nullptr) rule_.left->emplace(&tile, left);
  return left;
}

std::shared_ptr<const BlockTile> TileEvictor::Evict(const BlockTile& tile) {
  if (tile.CanBeUnread()) {
    return tile.loader()->WasUsed() && !rule_.even_used ? nullptr : tile.LeftTo(tile.loader()->Evicted());
  }
  if (spill_ == nullptr || !tile.CanBeLeft()) return nullptr;
  if (tile.part_id() >= rule_.written_lately && !rule_.even_used) return nullptr;
  auto place = spill_->Write(tile);
  CountSpilled(place.ok());
  if (!place.ok()) spill_ = nullptr;
  return place.ok() ? LeftAt(tile, std::move(place).value()) : nullptr;
}

}  // namespace dhpmap
