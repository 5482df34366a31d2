// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/map_rows.h"

#include <algorithm>
#include <utility>

#include "mapping/map/history_id.h"
#include "storage/rows/class_rows.h"
#include "storage/rows/config_rows.h"
#include "storage/rows/kept_clear_rows.h"
#include "storage/rows/map_parts.h"
#include "storage/rows/object_rows.h"
#include "storage/rows/session_rows.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadMapTask[] = "read the map";
constexpr char kWriteMapTask[] = "write the map";

Result<MapParts> ReadParts(Database& database, std::int64_t map_key) {
  MapParts parts;
  DHPMAP_ASSIGN_OR_RETURN(parts.config, ReadConfigRows(database, map_key));
  DHPMAP_ASSIGN_OR_RETURN(parts.classes, ReadClassRows(database, map_key));
  DHPMAP_ASSIGN_OR_RETURN(parts.sessions, ReadSessionRows(database, map_key));
  DHPMAP_ASSIGN_OR_RETURN(parts.merged, ReadMergedRows(database, map_key));
  DHPMAP_ASSIGN_OR_RETURN(parts.pairs, ReadPairRows(database, map_key));
  DHPMAP_ASSIGN_OR_RETURN(parts.kept_clear, ReadKeptClearRows(database, map_key));
  return parts;
}

/// Writes a row that was read, with a new seal; rows in other tables do not change.
Status Rewrite(Database& database, MapRow& row) {
  if (row.seal.version != MapSealVersion()) {
    DHPMAP_ASSIGN_OR_RETURN(const MapParts parts, ReadParts(database, row.key));
    SealMapParts(row, parts);
  }
  if (!row.CoversTiles()) {
    DHPMAP_ASSIGN_OR_RETURN(TileRows tiles, TileRows::Prepare(database));
    DHPMAP_ASSIGN_OR_RETURN(const TileTotals stored, tiles.Count(OwnerOfMap(row.key)));
    row.tiles.sum = stored.sum;  // the number remains as it was sealed
  }
  SealMapRow(row);
  DHPMAP_ASSIGN_OR_RETURN(Statement update, database.Prepare(Maps().Update("WHERE map_key = ?"), kWriteMapTask));
  Maps().BindChanges(row, update);
  return update.Bind(row.key).Run();
}

/// Writes merged ids, pairs and ignored regions with their checksums, if they differ from `before`.
Status UpdateObjects(Database& database, const MapRow& head, const MapInfo& before, MapRow& row) {
  const bool is_older = head.seal.version < MapSealVersion();
  const bool is_new = head.seal.version == 0;  // nothing is stored yet, regardless of `before`
  row.merged_checksum = head.merged_checksum;
  row.pairs_checksum = head.pairs_checksum;
  if (is_older || row.info.merged != before.merged) {
    DHPMAP_ASSIGN_OR_RETURN(const auto merged,
                            WriteMergedRows(database, head.key, is_new ? MergedIds() : before.merged, row.info.merged));
    row.merged_checksum = MergedChecksum(merged, MapSealVersion());
  }
  if (is_older || row.info.pairs != before.pairs) {
    DHPMAP_ASSIGN_OR_RETURN(const auto pairs,
                            WritePairRows(database, head.key, is_new ? ObjectPairs() : before.pairs, row.info.pairs));
    row.pairs_checksum = PairsChecksum(pairs, MapSealVersion());
  }
  row.kept_clear_checksum = head.kept_clear_checksum;
  if (is_older || row.info.kept_clear != before.kept_clear) {
    const KeptClear stored = is_new ? KeptClear() : before.kept_clear;
    DHPMAP_ASSIGN_OR_RETURN(const auto kept_clear, WriteKeptClearRows(database, head.key, stored, row.info.kept_clear));
    row.kept_clear_checksum = KeptClearChecksum(kept_clear, MapSealVersion());
  }
  return Status::Ok();
}

/// Advances numbers beyond the marks, and records the revisions between as lost.
Status GoBeyondMarks(Database& database, MapRow& row) {
  if (row.marks.revision > row.info.revision) {
    DHPMAP_ASSIGN_OR_RETURN(
        Statement insert,
        database.Prepare("INSERT INTO lost_revisions (map_key, first_revision, last_revision) VALUES (?, ?, ?)",
                         kWriteMapTask));
    DHPMAP_RETURN_IF_ERROR(insert.Bind(row.key).Bind(row.info.revision + 1).Bind(row.marks.revision).Run());
  }
  RaiseMarks(row);
  row.info.revision = row.marks.revision + 1;
  row.info.next_submap_id = row.marks.next_submap_id;
  RaiseMarks(row);
  return Rewrite(database, row);
}

Result<std::vector<std::string>> ReadNames(Database& database, const std::string& tail) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare("SELECT name FROM maps " + tail, "list the maps"));
  std::vector<std::string> names;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return names;
    names.push_back(select.Text(0));
  }
}

/// Calls change(MapRow&) for every map that `tail` selects, but not for damaged ones.
template <typename Change>
Status ForEachIntactMap(Database& database, const std::string& tail, Change&& change) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::string> names, ReadNames(database, tail));
  for (const std::string& name : names) {
    Result<MapRow> row = ReadMap(database, name);
    if (!row.ok() && row.status().code() != StatusCode::kDataLoss &&
        row.status().code() != StatusCode::kFailedPrecondition) {
      return row.status();
    }
    if (row.ok()) DHPMAP_RETURN_IF_ERROR(change(*row));
  }
  return Status::Ok();
}

}  // namespace

Result<MapRow> ReadMapHead(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare(Maps().Select("WHERE name = ?"), kReadMapTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(name).Step());
  if (!has_row) return NoSuchMap(name);
  MapRow row;
  if (!Maps().Read(select, row)) return DamagedRows(name, "its row has a wrong checksum");
  return row;
}

Result<MapRow> ReadMap(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(MapRow row, ReadMapHead(database, name));
  const auto parts = ReadParts(database, row.key);
  const Status read = parts.ok() ? FillInfo(row, *parts) : parts.status();
  if (read.code() == StatusCode::kDataLoss) return DamagedRows(name, read.message());
  DHPMAP_RETURN_IF_ERROR(read);
  return row;
}

Result<std::vector<std::string>> ReadMapNames(Database& database) { return ReadNames(database, "ORDER BY name"); }

Result<MapRow> InsertMap(Database& database, const MapSnapshot& snapshot) {
  MapRow row = MapRowOf(snapshot);
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, database.Prepare(Maps().Insert(), kWriteMapTask));
  Maps().BindAll(row, insert);  // other rows need its key, and its seal needs their checksums: sealed by a later update
  const Status inserted = insert.Run();
  if (inserted.code() == StatusCode::kAlreadyExists) {
    return AlreadyExists("there is already a map '" + row.info.name + "'").WithReason("MAP_EXISTS");
  }
  DHPMAP_RETURN_IF_ERROR(inserted);
  row.key = database.LastInsertRowId();
  return row;
}

Status UpdateMap(Database& database, const MapRow& head, const MapInfo& before, const MapSnapshot& after,
                 const StoredLayersOfMap& layers) {
  MapRow row = MapRowOf(after);
  row.tiles = layers.tiles;
  if (layers.leaving) row.leaving_id = std::int64_t{layers.leaving->value};
  const MapInfo& info = row.info;
  row.config_checksum = head.config_checksum;
  row.classes_checksum = head.classes_checksum;
  row.sessions_checksum = head.sessions_checksum;
  row.marks = head.marks;
  RaiseMarks(row);
  const bool is_older = head.seal.version < MapSealVersion();
  if (is_older || ConfigToText(info.config) != ConfigToText(before.config)) {
    DHPMAP_ASSIGN_OR_RETURN(const auto config, WriteConfigRows(database, head.key, info.config));
    row.config_checksum = ConfigChecksum(config);
  }
  if (is_older || (info.label_set != before.label_set && *info.label_set != *before.label_set)) {
    DHPMAP_ASSIGN_OR_RETURN(const auto classes, WriteClassRows(database, head.key, *info.label_set));
    row.classes_checksum = ClassesChecksum(classes, MapSealVersion());
  }
  if (is_older || info.sessions != before.sessions) {
    // A row without a seal is new: it has no sessions yet, regardless of `before`.
    const SessionMarks stored = head.seal.version == 0 ? SessionMarks() : before.sessions;
    DHPMAP_ASSIGN_OR_RETURN(const auto sessions, WriteSessionRows(database, head.key, stored, info.sessions));
    row.sessions_checksum = SessionsChecksum(sessions, MapSealVersion());
  }
  DHPMAP_RETURN_IF_ERROR(UpdateObjects(database, head, before, row));
  SealMapRow(row);
  DHPMAP_ASSIGN_OR_RETURN(Statement update, database.Prepare(Maps().Update("WHERE map_key = ?"), kWriteMapTask));
  Maps().BindChanges(row, update);
  return update.Bind(head.key).Run();
}

Status WriteRepairedMap(Database& database, MapRow& row) {
  ++row.info.revision;
  RaiseMarks(row);
  return Rewrite(database, row);
}

Status SetMarks(Database& database, const std::string& name, const NumberMarks& marks) {
  DHPMAP_ASSIGN_OR_RETURN(MapRow row, ReadMap(database, name));
  row.marks = marks;
  RaiseMarks(row);
  return Rewrite(database, row);
}

Status LeaveReservedNumbers(Database& database) {
  // One look at each row, so that a start hardly takes longer for many maps.
  return ForEachIntactMap(database, "WHERE revision_mark > revision OR submap_id_mark > next_submap_id",
                          [&database](MapRow& row) { return GoBeyondMarks(database, row); });
}

Result<LostRevisions> ReadLostRevisions(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare("SELECT first_revision, last_revision FROM lost_revisions WHERE map_key = ? "
                                           "ORDER BY first_revision",
                                           kReadMapTask));
  select.Bind(map_key);
  LostRevisions lost;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return lost;
    sqlite::Columns columns(select);
    const std::int64_t first = columns.Int();
    lost.push_back({.first = first, .last = columns.Int()});
  }
}

Status MarkAsBackup(Database& database) {
  return database.Execute("INSERT INTO backups (time_ns) SELECT CAST(strftime('%s', 'now') AS INTEGER) * 1000000000",
                          kWriteMapTask);
}

Status BeginHistoriesOfBackup(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_marks,
                          database.QueryInt("SELECT count(*) FROM backups", "see whether it is a backup"));
  if (num_marks == 0) return Status::Ok();
  DHPMAP_RETURN_IF_ERROR(ForEachIntactMap(database, "", [&database](MapRow& row) {
    row.info.history_id = DrawHistoryId();
    return Rewrite(database, row);
  }));
  return database.Execute("DELETE FROM backups", kWriteMapTask);
}

Status DeleteMapRows(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(Statement erase,
                          database.Prepare("DELETE FROM maps WHERE name = ? RETURNING map_key", "delete the map"));
  DHPMAP_ASSIGN_OR_RETURN(const bool erased, erase.Bind(name).Step());
  if (!erased) return NoSuchMap(name);
  return erase.Run();
}

}  // namespace dhpmap
