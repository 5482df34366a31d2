// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/state_bytes.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dhpmap {
namespace {

/// Bytes of a table's index from tile to position: an IndexMap, at most half full.
std::size_t TileIndexBytes(std::size_t num_tiles) {
  constexpr std::size_t kSlot_bytes = sizeof(TileIndex) + sizeof(std::uint32_t);
  return num_tiles == 0 ? 0 : std::bit_ceil(std::max<std::size_t>(8, 2 * num_tiles)) * kSlot_bytes;
}

template <typename Layer>
std::size_t BytesIfGone(const std::shared_ptr<const Layer>& layer, const std::shared_ptr<const Layer>* later) {
  return layer == nullptr || (later != nullptr && layer == *later) ? 0 : layer->MemoryBytes();
}

std::size_t TileBytesNotIn(const BlockTile& before, const BlockTile* later) {
  if (!before.IsRead()) return 0;
  if (later != nullptr && !later->IsRead()) later = nullptr;  // it will not share pages that it reads later
  std::size_t bytes = 0;
  for (const BlockEntry& block : before.entries()) {
    const BlockEntry* now = later != nullptr ? later->Find(CellOf(block.index)) : nullptr;
    bytes += BytesIfGone(block.tsdf, now != nullptr ? &now->tsdf : nullptr);
    bytes += BytesIfGone(block.labels, now != nullptr ? &now->labels : nullptr);
    bytes += BytesIfGone(block.gone, now != nullptr ? &now->gone : nullptr);
  }
  return bytes;
}

/// Bytes of the lists of a row.
std::size_t RowListBytes(const SubmapInfo& info) {
  std::size_t bytes = info.display_name.size() + info.class_counts.size() * sizeof(ClassTotal);
  for (const Sighting& sighting : info.sightings.all()) bytes += sizeof(Sighting) + sighting.session.size();
  return bytes;
}

/// Bytes of the lists in a map's row. Each state has its own, except for merged ids.
std::size_t MapListBytesNotIn(const MapInfo& before, const MapInfo& later) {
  std::size_t bytes = before.pairs.pairs().size_bytes();
  for (const SessionMark& mark : before.sessions.marks()) bytes += sizeof(SessionMark) + mark.session.size();
  for (const KeptClearRegion& region : before.kept_clear.list()) bytes += sizeof(KeptClearRegion) + region.name.size();
  const std::vector<MergedId>& merged = before.merged.list();
  return bytes + (&merged == &later.merged.list() ? 0 : merged.size() * sizeof(MergedId));
}

/// Bytes of row and tables of a submap that later is another object, without its blocks.
std::size_t TableBytesNotIn(const Submap& before, const Submap* later) {
  const std::span<const TileEntry> tiles = before.blocks().tiles_if_read();
  std::size_t bytes = sizeof(Submap) + RowListBytes(before.info()) + TileIndexBytes(tiles.size());
  for (const TileEntry& tile : tiles) {
    const TileEntry* now = later != nullptr ? later->blocks().FindTile(tile.index) : nullptr;
    const bool is_shared = now != nullptr && now->tile == tile.tile;
    bytes += sizeof(TileEntry) +
             (is_shared ? 0 : sizeof(BlockTile) + tile.tile->size() * sizeof(BlockEntry) + tile.tile->LabelsBytes());
  }
  return bytes;
}

std::size_t SpaceBytesNotIn(const std::shared_ptr<const FreeSpace>& before, const FreeSpace& later) {
  if (before.get() == &later) return 0;
  std::size_t bytes = sizeof(FreeSpace) + before->tiles().size_bytes() + TileIndexBytes(before->tiles().size());
  for (const FreeTileEntry& entry : before->tiles()) {
    if (later.Find(entry.index) != entry.tile.get()) bytes += entry.tile->MemoryBytes();
  }
  return bytes;
}

}  // namespace

std::size_t BlockBytesNotIn(const Submap& before, const Submap* later) {
  std::size_t bytes = 0;
  if (later != nullptr && before.blocks().SharesUnread(later->blocks())) {
    return bytes;  // not changed since the map was loaded
  }
  for (const TileEntry& tile : before.blocks().tiles_if_read()) {
    const TileEntry* now = later != nullptr ? later->blocks().FindTile(tile.index) : nullptr;
    if (now == nullptr || now->tile != tile.tile) {
      bytes += TileBytesNotIn(*tile.tile, now != nullptr ? now->tile.get() : nullptr);
    }
  }
  return bytes;
}

std::size_t StateBytesNotIn(const MapSnapshot& before, const MapSnapshot& later) {
  std::size_t bytes = sizeof(MapSnapshot) + before.submaps().size() * sizeof(before.submaps().front()) +
                      MapListBytesNotIn(before.info(), later.info());
  for (const auto& submap : before.submaps()) {
    const Submap* now = later.Find(submap->id());
    if (now != submap.get()) bytes += TableBytesNotIn(*submap, now) + BlockBytesNotIn(*submap, now);
  }
  return bytes + SpaceBytesNotIn(before.free_space(), *later.free_space()) +
         SpaceBytesNotIn(before.noted_vacated(), *later.noted_vacated());
}

}  // namespace dhpmap
