// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/tile_expiry.h"

#include "storage/rows/tile_rows.h"
#include "storage/sqlite/transaction.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kExpiryTask[] = "look for who needs a tile";

Result<bool> IsReferredTo(Database& database, std::int64_t blob_key) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT EXISTS (SELECT 1 FROM blob_references WHERE blob_key = ?)", kExpiryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(blob_key).Step());
  return has_row && select.Int(0) != 0;
}

/// Whether the map has as many submaps as its row records, or was deleted.
Result<bool> HasItsSubmaps(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT num_submaps, (SELECT count(*) FROM submaps WHERE submaps.map_key = maps.map_key) FROM "
                       "maps WHERE map_key = ?",
                       kExpiryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map_key).Step());
  return !has_row || select.Int(0) == select.Int(1);
}

/// Whether the submap has the tiles that its row records, or was deleted. False for a row of schema 6 or earlier, which
/// records none: its tiles were never replaced.
Result<bool> HasItsTiles(Database& database, std::int64_t submap_key) {
  constexpr std::int64_t kFirstThatCoversTiles = 3;
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT checksum_version, tiles_sum FROM submaps WHERE submap_key = ?", kExpiryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(submap_key).Step());
  if (!has_row) return true;
  if (select.Int(0) < kFirstThatCoversTiles) return false;
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::PrepareWithoutBlobs(database));
  TileTotals totals;
  DHPMAP_RETURN_IF_ERROR(rows.ForEach(submap_key, [&totals](const TileRowReader::Row& row) {
    totals.Add(row.index, row.layer, {.key = row.blob_key});
    return Status::Ok();
  }));
  return totals.sum == select.Int(1);
}

}  // namespace

Result<bool> IsGivenUp(Database& database, const TileOwner& owner, std::int64_t blob_key) {
  DHPMAP_ASSIGN_OR_RETURN(const sqlite::Transaction one_state, sqlite::Transaction::BeginRead(database));
  DHPMAP_ASSIGN_OR_RETURN(const bool is_referred_to, IsReferredTo(database, blob_key));
  if (is_referred_to) return false;
  return HasGoneOn(database, owner);
}

Result<bool> HasGoneOn(Database& database, const TileOwner& owner) {
  DHPMAP_ASSIGN_OR_RETURN(const bool has_submaps, HasItsSubmaps(database, owner.map_key));
  if (!has_submaps) return false;
  return HasItsTiles(database, owner.submap_key);
}

}  // namespace dhpmap
