// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/map_file.h"

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "storage/check/sqlite_check.h"
#include "storage/connection.h"
#include "storage/files/imported_map.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/schema/migrate.h"
#include "storage/sqlite/transaction.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

/// Of an imported file; the largest tile takes a few MiB.
constexpr int kMostValueBytes = 64 << 20;
constexpr char kExportTask[] = "export the map";
constexpr int kBusyTimeout_ms = 1000;

Status NotAMapFile(const std::string& why) {
  return InvalidArgument("the file is no exported map: " + why).WithReason("BAD_MAP");
}

/// A backup without the time of its state, so that a complete state always gives the same file. Copies rows with their
/// keys, which checksums cover. Both databases were created by the same steps, so columns have the same order. Leaves
/// out the state of the change log, lost revisions, and other data that are only valid in the map's history.
constexpr char kCopyMap[] = R"(
INSERT INTO main.map_config SELECT * FROM source.map_config WHERE map_key = (SELECT map_key FROM main.maps);
INSERT INTO main.label_classes SELECT * FROM source.label_classes WHERE map_key = (SELECT map_key FROM main.maps);
INSERT INTO main.feed_sessions SELECT * FROM source.feed_sessions WHERE map_key = (SELECT map_key FROM main.maps);
INSERT INTO main.merged_ids SELECT * FROM source.merged_ids WHERE map_key = (SELECT map_key FROM main.maps);
INSERT INTO main.object_pairs SELECT * FROM source.object_pairs WHERE map_key = (SELECT map_key FROM main.maps);
INSERT INTO main.kept_clear SELECT * FROM source.kept_clear WHERE map_key = (SELECT map_key FROM main.maps);
INSERT INTO main.submaps SELECT * FROM source.submaps WHERE map_key = (SELECT map_key FROM main.maps);
INSERT INTO main.submap_boxes (submap_key, min_x_m, max_x_m, min_y_m, max_y_m, min_z_m, max_z_m, map_key)
  SELECT submap_key, min_x_m, max_x_m, min_y_m, max_y_m, min_z_m, max_z_m, map_key FROM source.submap_boxes
  WHERE submap_key IN (SELECT submap_key FROM main.submaps);
INSERT INTO main.tiles SELECT * FROM source.tiles WHERE owner_key IN (SELECT submap_key FROM main.submaps)
  OR owner_key = (SELECT -map_key FROM main.maps);
INSERT INTO main.tile_blobs SELECT * FROM source.tile_blobs WHERE blob_key IN (SELECT blob_key FROM main.tiles);
INSERT INTO main.shared_blobs SELECT blob_key, count(*) - 1 FROM main.tiles GROUP BY blob_key HAVING count(*) > 1;
INSERT INTO main.backups (time_ns) SELECT update_time_ns FROM main.maps;
)";

Status CopyRows(Database& file, const std::string& name) {
  // Must not begin as a write transaction, which would lock the source, too.
  DHPMAP_ASSIGN_OR_RETURN(Transaction transaction, Transaction::BeginRead(file));
  DHPMAP_ASSIGN_OR_RETURN(Statement map,
                          file.Prepare("INSERT INTO main.maps SELECT * FROM source.maps WHERE name = ?", kExportTask));
  DHPMAP_RETURN_IF_ERROR(map.Bind(name).Run());
  if (file.NumChanges() == 0) return NotFound("there is no map '" + name + "'").WithReason("MAP_NOT_FOUND");
  DHPMAP_RETURN_IF_ERROR(file.Execute(kCopyMap, kExportTask));
  DHPMAP_RETURN_IF_ERROR(ReadMap(file, name).status());
  return transaction.Commit();
}

Status WriteTo(Database& file, const std::string& source_path, const std::string& name, const std::stop_token& stop) {
  DHPMAP_ASSIGN_OR_RETURN(Statement attach, file.Prepare("ATTACH ? AS source", kExportTask));
  DHPMAP_RETURN_IF_ERROR(attach.Bind(source_path).Run());
  if (stop.stop_requested()) return NobodyWaits();  // SQLite ignores an interrupt between two statements
  return CopyRows(file, name);
}

/// Only our own schema is permitted: a foreign trigger or view would run with our statements.
Status CheckFile(Database& file) {
  DHPMAP_RETURN_IF_ERROR(
      file.Execute("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON; "
                   "PRAGMA mmap_size = 0; PRAGMA temp_store = MEMORY",
                   "read the file"));
  DHPMAP_ASSIGN_OR_RETURN(const SchemaState schema, InspectSchema(file));
  if (schema == SchemaState::kEmpty) return NotAMapFile("it is empty");
  DHPMAP_RETURN_IF_ERROR(CheckNothingElse(file));
  DHPMAP_ASSIGN_OR_RETURN(
      const std::int64_t num_sound,
      file.QueryInt("SELECT count(*) FROM pragma_quick_check WHERE quick_check = 'ok'", "read the file"));
  if (num_sound != 1) return DataLoss("the file is damaged").WithReason("DAMAGED_MAP");
  return CheckRowCounts(file);  // before reading rows into memory
}

/// Migrates the file to the current schema. Rows converted from older tables are counted again.
Status BringUpToDate(Database& file) {
  DHPMAP_RETURN_IF_ERROR(file.Execute("PRAGMA foreign_keys = ON; PRAGMA synchronous = OFF", "read the file"));
  DHPMAP_RETURN_IF_ERROR(MigrateSchema(file));
  DHPMAP_RETURN_IF_ERROR(CheckRowCounts(file));
  return CheckTileIndices(file);  // later code uses their low 32 bits
}

/// Converts errors of SQLite to errors of the given file.
Status OfFile(const Status& status) {
  if (status.reason() == Reason("FOREIGN_DATABASE") ||
      (status.code() == StatusCode::kDataLoss && status.reason().empty())) {
    return NotAMapFile(status.message());
  }
  if (status.reason() == Reason("BAD_SCHEMA")) return NotAMapFile(status.message());
  if (status.reason() == Reason("BODY_TOO_LARGE")) return NotAMapFile("a value in it is larger than any of a map");
  return status;
}

Result<std::string> OnlyMapOf(Database& file) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::string> names, ReadMapNames(file));
  if (names.size() == 1) return names[0];
  return NotAMapFile("it holds " + std::to_string(names.size()) + " maps");
}

/// Checks the values of rows whose checksums are correct.
Status CheckSense(Database& file, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const MapRow map, ReadMap(file, name));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> submaps, ReadSubmaps(file, map.key));
  return ValidateImported(map.info, submaps);
}

Status VerifyFile(Database& file, const std::string& name, const std::stop_token& stop) {
  DHPMAP_ASSIGN_OR_RETURN(const Transaction transaction, Transaction::BeginRead(file));
  DHPMAP_ASSIGN_OR_RETURN(const Verification found, VerifyRows(file, name, VerifyScope::kState, stop));
  if (found.report.num_faults == 0) return CheckSense(file, name);
  const MapFault& first = found.report.faults.front();
  return DataLoss("the file is damaged in " + std::to_string(found.report.num_faults) + " places: " + first.place +
                  " " + first.what)
      .WithReason("DAMAGED_MAP");
}

}  // namespace

Result<Database> MakeMapFile(const std::string& path) {
  DHPMAP_ASSIGN_OR_RETURN(Database file, Database::Open(path, sqlite::OpenMode::kReadWriteOrCreate, kBusyTimeout_ms));
  DHPMAP_RETURN_IF_ERROR(
      file.Execute("PRAGMA page_size = 4096; PRAGMA auto_vacuum = INCREMENTAL; "
                   "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA temp_store = MEMORY",
                   kExportTask));  // what is not finished is removed
  DHPMAP_RETURN_IF_ERROR(MigrateSchema(file));
  return file;
}

Status WriteMapFile(const std::string& source_path, const std::string& name, const std::string& path,
                    const std::stop_token& stop) {
  const auto write = [&]() -> Status {
    DHPMAP_ASSIGN_OR_RETURN(Database file, MakeMapFile(path));
    const sqlite::StoppedBy stopped(file, stop);
    return WriteTo(file, source_path, name, stop);
  };
  Status status = write();
  if (status.ok() && stop.stop_requested()) status = NobodyWaits();
  if (!status.ok()) RemoveDatabase(path);
  return status;
}

Result<MapFile> MapFile::Open(const std::string& path, const std::stop_token& stop) {
  std::error_code none;
  if (fs::file_size(path, none) == 0 || none) return NotAMapFile("it is empty");
  DHPMAP_ASSIGN_OR_RETURN(Database file, Database::Open(path, sqlite::OpenMode::kReadWrite, kBusyTimeout_ms));
  file.LimitLength(kMostValueBytes);
  const auto prepare = [&]() -> Status {
    const sqlite::StoppedBy stopped(file, stop);
    DHPMAP_RETURN_IF_ERROR(CheckFile(file));
    return BringUpToDate(file);
  };
  DHPMAP_RETURN_IF_ERROR(OfFile(prepare()));
  Result<std::string> name = OnlyMapOf(file);
  if (!name.ok()) return OfFile(name.status());
  DHPMAP_RETURN_IF_ERROR(OfFile(VerifyFile(file, *name, stop)));
  return MapFile(std::move(file), std::move(name).value());
}

Status NobodyWaits() { return Cancelled("nobody waits for the map any more"); }

void RemoveDatabase(const std::string& path) {
  std::error_code ignored;
  for (const char* suffix : {"", "-journal", "-wal", "-shm"}) fs::remove(path + suffix, ignored);
}

}  // namespace dhpmap
