// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/tiles_ahead.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "mapping/base/index_map.h"
#include "mapping/map/map_grid.h"
#include "mapping/paging/read_tiles.h"
#include "mapping/submap/bounding_sphere.h"

namespace dhpmap {
namespace {

/// The tiles that contain ends of the segments, and those within `rim_blocks` blocks of an end.
class EndTiles {
 public:
  EndTiles(const std::vector<SegmentBundles>& segments, std::int32_t rim_blocks) {
    for (const SegmentBundles& segment : segments) {
      for (const BundleCell& cell : segment.cells) AddAround(cell.block, rim_blocks);
    }
  }

  [[nodiscard]] const std::vector<TileIndex>& all() const { return tiles_; }
  /// Whether the content of a sphere on the map's grid may include one of them.
  [[nodiscard]] bool MayMeet(const BoundingSphere& sphere, double voxel_size_m) const {
    if (tiles_.empty() || sphere.IsEmpty()) return false;
    const double side_m = kTileSide * kBlockSide * voxel_size_m;
    const Eigen::Array3d reach_m = Eigen::Array3d::Constant(sphere.radius_m + 1e-6);
    const Eigen::Array3d low = (sphere.center_m.array() - reach_m) / side_m;
    const Eigen::Array3d high = (sphere.center_m.array() + reach_m) / side_m;
    return (high >= low_.cast<double>()).all() && (low <= (high_ + 1).cast<double>()).all();
  }
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
    const Eigen::Array3i place(tile.x, tile.y, tile.z);
    low_ = tiles_.size() == 1 ? place : low_.min(place);
    high_ = tiles_.size() == 1 ? place : high_.max(place);
  }

  IndexMap<TileIndex> numbers_;  ///< index in tiles_
  std::vector<TileIndex> tiles_;
  Eigen::Array3i low_ = Eigen::Array3i::Zero(), high_ = Eigen::Array3i::Zero();  ///< bounds of tiles_
};

void AddIfUnread(const TileEntry* entry, std::vector<const BlockTile*>& unread) {
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
  // Farther tiles are read on demand.
  const EndTiles ends(segments, static_cast<std::int32_t>(std::min(rim_blocks, double{kTileSide})));
  std::vector<const BlockTile*> unread;
  for (const auto& submap : map.submaps()) {
    if (!IsOnMapGrid(submap->info(), config) || !ends.MayMeet(submap->bounding_sphere(), config.voxel_size_m)) continue;
    const BlockTable& blocks = submap->blocks();
    if (blocks.tiles().size() > ends.all().size()) {
      for (const TileIndex tile : ends.all()) AddIfUnread(blocks.FindTile(tile), unread);
    } else {
      for (const TileEntry& entry : blocks.tiles()) {
        if (ends.Has(entry.index)) AddIfUnread(&entry, unread);
      }
    }
  }
  ReadTiles(unread, [&pool](std::size_t count, const auto& body) { pool.ParallelFor(count, body); });
}

}  // namespace dhpmap
