// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/tiles_ahead.h"

#include <algorithm>
#include <cmath>

#include "mapping/base/index_map.h"
#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

/// The tiles that the segments end in, and those that are within so many blocks of an end.
class EndTiles {
 public:
  EndTiles(const std::vector<SegmentBundles>& segments, std::int32_t rim_blocks) {
    for (const SegmentBundles& segment : segments) {
      for (const BundleCell& cell : segment.cells) AddAround(cell.block, rim_blocks);
    }
  }

  [[nodiscard]] const std::vector<TileIndex>& all() const { return tiles_; }
  [[nodiscard]] bool Has(TileIndex tile) const { return numbers_.Find(tile) != IndexMap<TileIndex>::kNone; }

 private:
  void AddAround(BlockIndex block, std::int32_t rim) {
    const TileIndex low = TileOf({block.x - rim, block.y - rim, block.z - rim});
    const TileIndex high = TileOf({block.x + rim, block.y + rim, block.z + rim});
    for (std::int32_t z = low.z; z <= high.z; ++z) {
      for (std::int32_t y = low.y; y <= high.y; ++y) {
        for (std::int32_t x = low.x; x <= high.x; ++x) Add({x, y, z});
      }
    }
  }
  void Add(TileIndex tile) {
    if (Has(tile)) return;
    numbers_.Set(tile, static_cast<std::uint32_t>(tiles_.size()));
    tiles_.push_back(tile);
  }

  IndexMap<TileIndex> numbers_;  ///< position in tiles_
  std::vector<TileIndex> tiles_;
};

void AddUnread(const TileEntry* entry, std::vector<const BlockTile*>& unread) {
  if (entry != nullptr && !entry->tile->IsRead()) unread.push_back(entry->tile.get());
}

}  // namespace

bool HasTilesOnDisk(const Map& map) {
  return std::any_of(map.submaps().begin(), map.submaps().end(), [](const auto& submap) {
    const auto tiles = submap->blocks().tiles_if_read();
    if (tiles.empty() && !submap->blocks().empty()) return true;
    return std::any_of(tiles.begin(), tiles.end(), [](const TileEntry& entry) { return !entry.tile->IsRead(); });
  });
}

void ReadTilesAhead(const std::vector<SegmentBundles>& segments, const Map& map, ThreadPool& pool) {
  const MapConfig& config = map.info().config;
  const double rim_blocks = std::ceil(config.truncation_m / (kBlockSide * config.voxel_size_m));
  // What is farther is read when it is needed.
  const EndTiles ends(segments, static_cast<std::int32_t>(std::min(rim_blocks, double{kTileSide})));
  std::vector<const BlockTile*> unread;
  for (const auto& submap : map.submaps()) {
    if (!IsOnMapGrid(submap->info(), config)) continue;
    const BlockTable& blocks = submap->blocks();
    if (blocks.tiles().size() > ends.all().size()) {
      for (const TileIndex tile : ends.all()) AddUnread(blocks.FindTile(tile), unread);
    } else {
      for (const TileEntry& entry : blocks.tiles()) {
        if (ends.Has(entry.index)) AddUnread(&entry, unread);
      }
    }
  }
  pool.ParallelFor(unread.size(), [&unread](std::size_t i) { (void)unread[i]->entries(); });
}

}  // namespace dhpmap
