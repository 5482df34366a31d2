// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/stored_submap.h"

#include <optional>
#include <utility>

#include "storage/paging/tile_expiry.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/transaction.h"

namespace dhpmap {
namespace {

/// The checksum of a submap's tiles in its current row; nothing if there is no such submap.
Result<std::optional<std::int64_t>> PresentSum(sqlite::Database& database, std::int64_t submap_key) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement select,
                          database.Prepare("SELECT tiles_sum FROM submaps WHERE submap_key = ?", "read a tile"));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(submap_key).Step());
  return has_row ? std::optional<std::int64_t>(select.Int(0)) : std::nullopt;
}

}  // namespace

StoredSubmap::StoredSubmap(std::shared_ptr<TileBlobs> blobs, std::uint16_t store, std::shared_ptr<SharedTiles> shared,
                           const std::string& map, const SubmapRow& row)
    : SubmapTiles(store, std::move(shared), map, row), blobs_(std::move(blobs)), owner_{row.map_key, row.key} {}

Result<std::vector<TileDirectory::Tile>> StoredSubmap::ReadAll() {
  return blobs_->With<std::vector<Tile>>(name(), [this](sqlite::Database& database) -> Result<std::vector<Tile>> {
    DHPMAP_ASSIGN_OR_RETURN(const sqlite::Transaction one_state, sqlite::Transaction::BeginRead(database));
    DHPMAP_ASSIGN_OR_RETURN(TileRowReader reader, TileRowReader::PrepareWithoutBlobs(database));
    Collector all(*this);
    DHPMAP_RETURN_IF_ERROR(reader.ForEach(owner_.submap_key, [&all](const TileRow& row) { return all.Add(row); }));
    if (all.AreOthers()) return WhyOthers(database);
    const Status found = all.Check();
    if (!found.ok()) return Damaged(found);
    return all.Tiles();
  });
}

Result<std::shared_ptr<const BlockTile>> StoredSubmap::ReadOne(TileIndex index) {
  using Made = std::shared_ptr<const BlockTile>;
  return blobs_->With<Made>(name(), [&](sqlite::Database& database) -> Result<Made> {
    DHPMAP_ASSIGN_OR_RETURN(const sqlite::Transaction one_state, sqlite::Transaction::BeginRead(database));
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<std::int64_t> sum, PresentSum(database, owner_.submap_key));
    if (tiles_sum() && sum != tiles_sum()) return WhyOthers(database);
    DHPMAP_ASSIGN_OR_RETURN(TileRowReader reader, TileRowReader::PrepareForATile(database));
    Rows rows;
    rows.tile.index = index;
    DHPMAP_RETURN_IF_ERROR(
        reader.ForEachOf(owner_.submap_key, index, [&](const TileRow& row) { return Add(row, rows); }));
    return AnyOf(rows.tile.cells) != 0 ? Make(rows) : nullptr;
  });
}

Status StoredSubmap::WhyOthers(sqlite::Database& database) const {
  DHPMAP_ASSIGN_OR_RETURN(const bool has_gone_on, HasGoneOn(database, owner_));
  return has_gone_on ? Expired(name() + ": what is asked for") : Damaged(OtherTiles());
}

}  // namespace dhpmap
