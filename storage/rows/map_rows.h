// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mapping/map/map.h"
#include "storage/rows/map_row.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// Rows of maps, map_config, label_classes, feed_sessions, merged_ids, object_pairs and kept_clear <-> MapInfo. A map's
// row has a checksum that covers the checksums of the other tables; readers return DATA_LOSS on a mismatch.

/// The stored layers of a map itself.
struct StoredLayersOfMap {
  TileTotals tiles;
  std::optional<SubmapId> leaving;  ///< as MapSnapshot::leaving, if its old place is not stored yet
};

/// NOT_FOUND if there is no such map. FAILED_PRECONDITION if its config has unknown or retired keys.
Result<MapRow> ReadMap(sqlite::Database& database, const std::string& name);
/// Names in ascending order.
Result<std::vector<std::string>> ReadMapNames(sqlite::Database& database);
/// The row alone, unverified, without config, label set and sessions: for the comparison of a commit with its base.
Result<MapRow> ReadMapHead(sqlite::Database& database, const std::string& name);

/// Adds a row with the identity of a map; UpdateMap fills it. Returns it. ALREADY_EXISTS if the name is in use.
Result<MapRow> InsertMap(sqlite::Database& database, const MapSnapshot& snapshot);
/// Writes config, label set and sessions only if they differ from `before`, or have a checksum of an older version.
/// `layers`: the stored ones of `after`.
Status UpdateMap(sqlite::Database& database, const MapRow& head, const MapInfo& before, const MapSnapshot& after,
                 const StoredLayersOfMap& layers);
/// Writes a repaired row as the next revision.
Status WriteRepairedMap(sqlite::Database& database, MapRow& row);
/// See MapStore::Reserve.
Status SetMarks(sqlite::Database& database, const std::string& name, const NumberMarks& marks);
/// Moves every map with marks above its numbers beyond them, and records the skipped revisions. Ignores damaged maps.
Status LeaveReservedNumbers(sqlite::Database& database);
/// The revisions that LeaveReservedNumbers has recorded for a map.
Result<LostRevisions> ReadLostRevisions(sqlite::Database& database, std::int64_t map_key);
/// Marks the database as a backup.
Status MarkAsBackup(sqlite::Database& database);
/// In a backup: gives every map a new history, because other copies of the same states may continue too, and removes
/// the mark. Ignores damaged maps.
Status BeginHistoriesOfBackup(sqlite::Database& database);
/// Deletes a map with all its data. NOT_FOUND if there is no such map.
Status DeleteMapRows(sqlite::Database& database, const std::string& name);

}  // namespace dhpmap
