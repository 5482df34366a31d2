// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/stored_submap.h"

#include <bit>
#include <optional>
#include <utility>

#include "mapping/paging/tile_page.h"
#include "storage/paging/tile_expiry.h"
#include "storage/sqlite/transaction.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

/// The checksum of a submap's tiles in its current row; nothing if there is no such submap.
Result<std::optional<std::int64_t>> PresentSum(sqlite::Database& database, std::int64_t submap_key) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement select,
                          database.Prepare("SELECT tiles_sum FROM submaps WHERE submap_key = ?", "read a tile"));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(submap_key).Step());
  return has_row ? std::optional<std::int64_t>(select.Int(0)) : std::nullopt;
}

void Count(const TileOnDisk& tile, SubmapCounts& counts) {
  for (const ObjectLayer& layer : ObjectLayers()) {
    if (layer.count == nullptr) continue;
    counts.*layer.count += std::popcount(tile.cells[static_cast<std::size_t>(layer.layer)]);
  }
}

}  // namespace

std::shared_ptr<const BlockTile> SharedTiles::Find(const TileKeys& keys, std::shared_ptr<const BlockTile> made) {
  const MutexLock lock(mutex_);
  std::weak_ptr<const BlockTile>& known = tiles_[keys];
  if (auto tile = known.lock()) return tile;
  known = made;
  return made;
}

StoredSubmap::StoredSubmap(std::shared_ptr<TileBlobs> blobs, std::uint16_t store, std::shared_ptr<SharedTiles> shared,
                           const std::string& map, const SubmapRow& row)
    : blobs_(std::move(blobs)),
      shared_(std::move(shared)),
      name_("map '" + map + "': submap " + std::to_string(row.info.id.value)),
      owner_{row.map_key, row.key},
      counts_(row.counts),
      tiles_sum_(row.CoversTiles() ? std::optional(row.tiles_sum) : std::nullopt),
      store_(store) {}

Result<std::vector<TileDirectory::Tile>> StoredSubmap::ReadAll() {
  return blobs_->With<std::vector<Tile>>(name_, [this](sqlite::Database& database) -> Result<std::vector<Tile>> {
    DHPMAP_ASSIGN_OR_RETURN(const sqlite::Transaction one_state, sqlite::Transaction::BeginRead(database));
    DHPMAP_ASSIGN_OR_RETURN(TileRowReader reader, TileRowReader::PrepareWithoutBlobs(database));
    std::vector<Rows> all;
    TileTotals totals;
    DHPMAP_RETURN_IF_ERROR(reader.ForEach(owner_.submap_key, [&](const TileRowReader::Row& row) -> Status {
      totals.Add(row.index, row.layer, {.key = row.blob_key});
      if (all.empty() || all.back().tile.index != row.index) all.emplace_back().tile.index = row.index;
      return Add(row, all.back());
    }));
    SubmapCounts counts;
    for (const Rows& rows : all) Count(rows.tile, counts);
    DHPMAP_RETURN_IF_ERROR(Check(database, counts, totals));
    std::vector<Tile> tiles;
    tiles.reserve(all.size());
    for (const Rows& rows : all) tiles.push_back({rows.tile.index, Make(rows)});
    return tiles;
  });
}

Result<std::shared_ptr<const BlockTile>> StoredSubmap::ReadOne(TileIndex index) {
  using Made = std::shared_ptr<const BlockTile>;
  return blobs_->With<Made>(name_, [&](sqlite::Database& database) -> Result<Made> {
    DHPMAP_ASSIGN_OR_RETURN(const sqlite::Transaction one_state, sqlite::Transaction::BeginRead(database));
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<std::int64_t> sum, PresentSum(database, owner_.submap_key));
    if (tiles_sum_ && sum != tiles_sum_) return Check(database, {}, {});  // which finds the cause
    DHPMAP_ASSIGN_OR_RETURN(TileRowReader reader, TileRowReader::PrepareForATile(database));
    Rows rows;
    rows.tile.index = index;
    DHPMAP_RETURN_IF_ERROR(
        reader.ForEachOf(owner_.submap_key, index, [&](const TileRowReader::Row& row) { return Add(row, rows); }));
    return AnyOf(rows.tile.cells) != 0 ? Make(rows) : nullptr;
  });
}

bool StoredSubmap::HasFew() const {
  constexpr std::int64_t kFewBlocks = 2000;  // in about 100 rows, which take 60 us to read
  return counts_.num_tsdf_blocks + counts_.num_label_blocks + counts_.num_gone_blocks <= kFewBlocks;
}

Status StoredSubmap::Add(const TileRowReader::Row& row, Rows& rows) const {
  const ObjectLayer* layer = FindObjectLayer(row.layer);
  if (layer == nullptr) {
    return FailedPrecondition(name_ + ": " + NameOfTile("layer " + std::to_string(row.layer), row.index) +
                              " is of a layer unknown to this version")
        .WithReason("NEWER_LAYER");
  }
  if (row.cells == 0) return Expired(name_ + ": what is asked for");  // reset by a repair since
  const auto i = static_cast<std::size_t>(layer->layer);
  rows.tile.keys[i] = row.blob_key;
  rows.tile.cells[i] = row.cells;
  if (layer->layer == BlockLayer::kTsdf) rows.tile.extent = row.extent;
  rows.is_shared = rows.is_shared || row.is_shared;
  return Status::Ok();
}

std::shared_ptr<const BlockTile> StoredSubmap::Make(const Rows& rows) {
  TileOnDisk tile = rows.tile;
  tile.store = store_;
  auto made = std::make_shared<const BlockTile>(std::make_shared<const TilePage>(tile, shared_from_this()));
  return rows.is_shared ? shared_->Find(tile.keys, std::move(made)) : made;
}

Status StoredSubmap::Check(sqlite::Database& database, const SubmapCounts& counts, const TileTotals& totals) const {
  const bool is_same = tiles_sum_.value_or(totals.sum) == totals.sum && totals.num_rows > 0;
  const Status found = is_same ? CheckCounts(counts, counts_) : DataLoss("has other tiles than were stored");
  if (found.ok()) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(const bool has_gone_on, HasGoneOn(database, owner_));
  if (!is_same && has_gone_on) return Expired(name_ + ": what is asked for");
  return DataLoss(name_ + ": " + found.message()).WithReason("DAMAGED_MAP");
}

}  // namespace dhpmap
