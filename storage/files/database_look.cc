// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "storage/files/file_lock.h"
#include "storage/files/upgrade_copy.h"
#include "storage/schema/migrate.h"
#include "storage/sqlite/database.h"
#include "storage/sqlite_store.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

Status NotWritable(const std::string& what) {
  return FailedPrecondition("the database is not writable: " + what).WithReason("NOT_WRITABLE");
}

/// Files next to a database come and go: its log, its lock.
Status CheckFolder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) return NotFound("the folder of the database does not exist");
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return Status::Ok();
  return NotWritable("files cannot be made in its folder");
}

/// Includes the log left by a killed server. Without a log the file is complete, and no file is created next to it.
Result<sqlite::Database> OpenForLook(const fs::path& file) {
  constexpr int kBusyTimeout_ms = 1000;
  std::error_code missing;
  const bool has_log = fs::file_size(file.string() + "-wal", missing) > 0 && !missing;
  return sqlite::Database::Open(
      file.string(), has_log ? sqlite::OpenMode::kReadOnly : sqlite::OpenMode::kReadOnlyImmutable, kBusyTimeout_ms);
}

Status LookInside(const fs::path& file, DatabaseLook& look) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Database database, OpenForLook(file));
  DHPMAP_RETURN_IF_ERROR(InspectSchema(database).status());
  DHPMAP_ASSIGN_OR_RETURN(look.schema, database.QueryInt("PRAGMA user_version", "read the database's version"));
  if (look.schema == 0 || look.schema == look.server_schema) return Status::Ok();
  look.copy_path = UpgradeCopyPath(file.string(), look.server_schema);
  DHPMAP_ASSIGN_OR_RETURN(look.copy_bytes, UpgradeCopyBytes(database));
  look.has_room_for_copy = look.free_bytes >= look.copy_bytes + kFreeBesideCopy_bytes;
  return Status::Ok();
}

}  // namespace

Result<DatabaseLook> LookAtDatabase(const std::string& path) {
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(path, error);
  const fs::path file = error ? fs::path(path) : resolved;
  DHPMAP_RETURN_IF_ERROR(CheckFolder(file));
  DatabaseLook look{.is_there = fs::exists(file, error), .server_schema = SchemaVersion()};
  DHPMAP_ASSIGN_OR_RETURN(look.free_bytes, FreeBytesBeside(path));
  if (!look.is_there) return look;
  if (!fs::is_regular_file(file, error)) {
    return FailedPrecondition("the database is not a file").WithReason("NOT_A_FILE");
  }
  if (::access(file.c_str(), R_OK | W_OK) != 0) return NotWritable("the file may not be read and written");
  look.holder = FileLock::HolderOf(file.string());
  if (!look.holder.empty() || fs::file_size(file, error) == 0) return look;
  const Status inside = LookInside(file, look);
  if (!inside.ok()) return WithWayBack(inside, path);
  return look;
}

}  // namespace dhpmap
