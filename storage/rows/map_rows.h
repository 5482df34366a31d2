// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mapping/map/map.h"
#include "storage/rows/table.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// Rows of maps, map_config, label_classes, feed_sessions, merged_ids, object_pairs and kept_clear <-> MapInfo. A map's
// row is sealed by a checksum that covers the others by checksums of their own, of what is stored in them; readers
// answer DATA_LOSS where one does not match.

struct MapRow {
  std::int64_t key = 0;
  MapInfo info;
  std::int64_t num_submaps = 0;
  std::uint32_t config_checksum = 0;
  std::uint32_t classes_checksum = 0;
  NumberMarks marks;
  std::uint32_t sessions_checksum = 0;
  TileTotals tiles;  ///< of the layers that belong to the map itself
  std::uint32_t merged_checksum = 0;
  std::uint32_t pairs_checksum = 0;
  std::uint32_t kept_clear_checksum = 0;
  std::int64_t leaving_id = -1;  ///< of the submap that its last edit moved, if what that left is still to be written
  RowSeal seal;

  /// Nothing for -1, and for what is no id.
  [[nodiscard]] std::optional<SubmapId> leaving() const {
    const bool is_id = leaving_id >= 0 && leaving_id <= std::numeric_limits<std::uint32_t>::max();
    return is_id ? std::optional(SubmapId(static_cast<std::uint32_t>(leaving_id))) : std::nullopt;
  }

  /// Whether it says what its rows in tiles are; those that schema 6 and before sealed only count them.
  [[nodiscard]] bool CoversTiles() const { return seal.version >= 6; }
};

/// The columns of table maps. `Row` is a MapRow, or derived from it. The order of those that a released version of the
/// checksum covers is never changed: new ones go to the end.
template <typename Row = MapRow>
std::vector<Column<Row>> MapColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kElsewhere, 0, DHPMAP_MEMBER(key)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("name", kOnce, 1, DHPMAP_MEMBER(info.name)),
      MakeColumn<Row>("display_name", kAlways, 1, DHPMAP_MEMBER(info.display_name)),
      MakeColumn<Row>("revision", kAlways, 1, DHPMAP_MEMBER(info.revision)),
      MakeColumn<Row>("num_frames", kAlways, 1, DHPMAP_MEMBER(info.num_frames)),
      MakeColumn<Row>("next_submap_id", kAlways, 1, DHPMAP_MEMBER(info.next_submap_id)),
      MakeColumn<Row>("create_time_ns", kOnce, 1, DHPMAP_MEMBER(info.create_time_ns)),
      MakeColumn<Row>("update_time_ns", kAlways, 1, DHPMAP_MEMBER(info.update_time_ns)),
      MakeColumn<Row>("num_submaps", kAlways, 1, DHPMAP_MEMBER(num_submaps)),
      MakeColumn<Row>("config_checksum", kAlways, 2, DHPMAP_MEMBER(config_checksum)),
      MakeColumn<Row>("classes_checksum", kAlways, 2, DHPMAP_MEMBER(classes_checksum)),
      MakeColumn<Row>("revision_mark", kAlways, 2, DHPMAP_MEMBER(marks.revision)),
      MakeColumn<Row>("submap_id_mark", kAlways, 2, DHPMAP_MEMBER(marks.next_submap_id)),
      MakeColumn<Row>("sessions_checksum", kAlways, 3, DHPMAP_MEMBER(sessions_checksum)),
      MakeColumn<Row>("history_id", kAlways, 3, DHPMAP_MEMBER(info.history_id)),
      MakeColumn<Row>("num_tiles", kAlways, 4, DHPMAP_MEMBER(tiles.num_rows)),
      MakeColumn<Row>("tile_bytes", kAlways, 0, DHPMAP_MEMBER(tiles.bytes)),
      MakeColumn<Row>("merged_checksum", kAlways, 5, DHPMAP_MEMBER(merged_checksum)),
      MakeColumn<Row>("pairs_checksum", kAlways, 5, DHPMAP_MEMBER(pairs_checksum)),
      MakeColumn<Row>("tiles_sum", kAlways, 6, DHPMAP_MEMBER(tiles.sum)),
      MakeColumn<Row>("kept_clear_checksum", kAlways, 7, DHPMAP_MEMBER(kept_clear_checksum)),
      MakeColumn<Row>("leaving_submap_id", kAlways, 8, DHPMAP_MEMBER(leaving_id)),
  };
}
const Table<MapRow>& Maps();

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
