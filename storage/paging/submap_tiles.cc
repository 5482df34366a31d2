// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/submap_tiles.h"

#include <bit>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/paging/tile_page.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

void CountTile(const TileOnDisk& tile, SubmapCounts& counts) {
  for (const ObjectLayer& layer : ObjectLayers()) {
    if (layer.count == nullptr) continue;
    counts.*layer.count += std::popcount(tile.cells[static_cast<std::size_t>(layer.layer)]);
  }
}

}  // namespace

Status Expired(const std::string& what) {
  return Aborted(what + " is of a state that was held while the map went on: ask for its present one")
      .WithReason("SNAPSHOT_EXPIRED");
}

std::shared_ptr<const BlockTile> SharedTiles::Find(const TileKeys& keys, std::shared_ptr<const BlockTile> made) {
  const MutexLock lock(mutex_);
  std::weak_ptr<const BlockTile>& known = tiles_[keys];
  if (auto tile = known.lock()) return tile;
  known = made;
  return made;
}

SubmapTiles::SubmapTiles(std::uint16_t store, std::shared_ptr<SharedTiles> shared, const std::string& map,
                         const SubmapRow& row)
    : shared_(std::move(shared)),
      name_("map '" + map + "': submap " + std::to_string(row.info.id.value)),
      counts_(row.counts),
      tiles_sum_(row.CoversTiles() ? std::optional(row.tiles_sum) : std::nullopt),
      store_(store) {}

bool SubmapTiles::HasFew() const {
  constexpr std::int64_t kFewBlocks = 2000;  // in some 100 rows, which are read in 60 us
  return counts_.num_tsdf_blocks + counts_.num_label_blocks + counts_.num_gone_blocks <= kFewBlocks;
}

Status SubmapTiles::Add(const TileRow& row, Rows& rows) const {
  const ObjectLayer* layer = FindObjectLayer(row.layer);
  if (layer == nullptr) {
    return FailedPrecondition(name_ + ": " + NameOfTile("layer " + std::to_string(row.layer), row.index) +
                              " is of a layer unknown to this version")
        .WithReason("NEWER_LAYER");
  }
  if (row.cells == 0) return Expired(name_ + ": what is asked for");  // a repair has been here: it said them
  const auto i = static_cast<std::size_t>(layer->layer);
  rows.tile.keys[i] = row.blob_key;
  rows.tile.cells[i] = row.cells;
  if (layer->layer == BlockLayer::kTsdf) rows.tile.extent = row.extent;
  rows.is_shared = rows.is_shared || row.is_shared;
  return Status::Ok();
}

std::shared_ptr<const BlockTile> SubmapTiles::Make(const Rows& rows) {
  TileOnDisk tile = rows.tile;
  tile.store = store_;
  auto made = std::make_shared<const BlockTile>(std::make_shared<const TilePage>(tile, shared_from_this()));
  return rows.is_shared ? shared_->Find(tile.keys, std::move(made)) : made;
}

Status SubmapTiles::Damaged(const Status& what) const {
  return DataLoss(name_ + ": " + what.message()).WithReason("DAMAGED_MAP");
}

Status SubmapTiles::Collector::Add(const TileRow& row) {
  totals_.Add(row.index, row.layer, {.key = row.blob_key});
  if (all_.empty() || all_.back().tile.index != row.index) all_.emplace_back().tile.index = row.index;
  return submap_.Add(row, all_.back());
}

bool SubmapTiles::Collector::AreOthers() const {
  return totals_.num_rows == 0 || submap_.tiles_sum_.value_or(totals_.sum) != totals_.sum;
}

Status SubmapTiles::Collector::Check() const {
  if (AreOthers()) return OtherTiles();
  SubmapCounts counts;
  for (const Rows& rows : all_) CountTile(rows.tile, counts);
  return CheckCounts(counts, submap_.counts_);
}

std::vector<TileDirectory::Tile> SubmapTiles::Collector::Tiles() {
  std::vector<Tile> tiles;
  tiles.reserve(all_.size());
  for (const Rows& rows : all_) tiles.push_back({rows.tile.index, submap_.Make(rows)});
  return tiles;
}

Status OtherTiles() { return DataLoss("has other tiles than were stored"); }

bool HasTiles(const SubmapRow& row) {
  return row.counts.num_tsdf_blocks + row.counts.num_label_blocks + row.counts.num_gone_blocks > 0;
}

Result<std::shared_ptr<const Submap>> UnreadSubmap(const SubmapRow& row, std::shared_ptr<SubmapTiles> tiles) {
  constexpr std::uint64_t kOlderThanAnyWriter = 0;
  auto submap =
      std::make_shared<Submap>(row.info, kOlderThanAnyWriter, std::make_shared<const UnreadTiles>(std::move(tiles)));
  submap->set_bounding_sphere(row.sphere);
  submap->kept_outline().Keep(row.outline);
  if (!row.CoversTiles()) {
    Status read = Guarded<Status>([&submap] {
      (void)submap->blocks().tiles();
      return Status::Ok();
    });
    if (!read.ok()) return read;
  }
  return std::shared_ptr<const Submap>(std::move(submap));
}

}  // namespace dhpmap
