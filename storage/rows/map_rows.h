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
// row is sealed by a checksum that covers the others by checksums of their own, of what is stored in them; readers
// answer DATA_LOSS where one does not match.

/// What is stored of a map's own layers.
struct StoredLayersOfMap {
  TileTotals tiles;
  std::optional<SubmapId> leaving;  ///< as MapSnapshot::leaving, if what it left is not among them
};

/// NOT_FOUND if there is no such map. FAILED_PRECONDITION if its config has keys that this version does not know.
Result<MapRow> ReadMap(sqlite::Database& database, const std::string& name);
/// Names in ascending order.
Result<std::vector<std::string>> ReadMapNames(sqlite::Database& database);
/// The row alone, not checked, without config, label set and sessions: what a commit compares with the state it starts
/// from.
Result<MapRow> ReadMapHead(sqlite::Database& database, const std::string& name);

/// Adds a row with what identifies a map; UpdateMap fills it. Returns it. ALREADY_EXISTS if the name is taken.
Result<MapRow> InsertMap(sqlite::Database& database, const MapSnapshot& snapshot);
/// Writes config, label set and sessions only where they differ from `before`, or were sealed by an older version.
/// `layers`: those of `after` as they are stored.
Status UpdateMap(sqlite::Database& database, const MapRow& head, const MapInfo& before, const MapSnapshot& after,
                 const StoredLayersOfMap& layers);
/// Writes a row that was read and changed, as the revision after it.
Status WriteRepairedMap(sqlite::Database& database, MapRow& row);
/// See MapStore::Reserve.
Status SetMarks(sqlite::Database& database, const std::string& name, const NumberMarks& marks);
/// Takes every map whose marks are above its numbers beyond them, and notes the revisions that are left out. Leaves
/// damaged maps alone.
Status LeaveReservedNumbers(sqlite::Database& database);
/// What LeaveReservedNumbers has noted of a map.
Result<LostRevisions> ReadLostRevisions(sqlite::Database& database, std::int64_t map_key);
/// Says in the database that it is a backup.
Status MarkAsBackup(sqlite::Database& database);
/// If it is one: gives every map a history of its own, since others may go on from another copy of the same states, and
/// takes the mark off. Leaves damaged maps alone.
Status BeginHistoriesOfBackup(sqlite::Database& database);
/// With everything it holds. NOT_FOUND if there is no such map.
Status DeleteMapRows(sqlite::Database& database, const std::string& name);

}  // namespace dhpmap
