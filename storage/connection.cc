// SPDX-License-Identifier: BSD-3-Clause
#include "storage/connection.h"

#include <filesystem>
#include <utility>

#include "storage/schema/migrate.h"
#include "storage/sqlite/free_pages.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::OpenMode;

constexpr char kSetUpTask[] = "set up the database";
constexpr std::size_t kMaxIdleReaders = 4;

// No mmap: it would scan 2.6 times as fast as read(), but if somebody truncates the file, the process would end by
// SIGBUS; and mapped pages count as our memory. secure_delete, on in Debian's build, would overwrite all replaced data
// with zeros.
constexpr char kEveryConnection[] = "PRAGMA mmap_size = 0; PRAGMA cache_size = -16384; PRAGMA temp_store = MEMORY;";
constexpr char kWriterConnection[] =
    "PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON; PRAGMA secure_delete = OFF; PRAGMA cache_size = -65536; "
    "PRAGMA wal_autocheckpoint = 4096; PRAGMA journal_size_limit = 67108864;";

Status NotWritable() { return FailedPrecondition("the database is not writable").WithReason("NOT_WRITABLE"); }

/// Whether a writer left commits in the log that are not in the database file.
bool HasLog(const std::string& path) {
  std::error_code missing;
  return std::filesystem::file_size(path + "-wal", missing) > 0 && !missing;
}

/// OK for a missing file, which may be created.
Status CheckIsFile(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored) || !std::filesystem::exists(path, ignored)) return Status::Ok();
  return FailedPrecondition("the database is not a file").WithReason("NOT_A_FILE");
}

Result<Database> OpenReader(const std::string& path, OpenMode mode, int busy_timeout_ms) {
  DHPMAP_ASSIGN_OR_RETURN(Database database, Database::Open(path, mode, busy_timeout_ms));
  DHPMAP_RETURN_IF_ERROR(database.Execute(kEveryConnection, kSetUpTask));
  return database;
}

/// SQLite returns the resulting mode.
Status SwitchToLog(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement pragma, database.Prepare("PRAGMA journal_mode = WAL", kSetUpTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, pragma.Step());
  if (has_row && pragma.Text(0) == "wal") return Status::Ok();
  return FailedPrecondition("the file system of the database cannot hold a write-ahead log").WithReason("NO_WAL");
}

}  // namespace

Result<Database> OpenWriter(const std::string& path, int busy_timeout_ms, const UpgradeCopyOptions& copy) {
  DHPMAP_RETURN_IF_ERROR(CheckIsFile(path));
  DHPMAP_ASSIGN_OR_RETURN(Database database, Database::Open(path, OpenMode::kReadWriteOrCreate, busy_timeout_ms));
  database.SetCheckpointOnClose(false);  // until the file is known to be ours
  DHPMAP_ASSIGN_OR_RETURN(const SchemaState schema, InspectSchema(database));
  if (database.IsReadOnly()) return NotWritable();
  database.SetCheckpointOnClose(true);
  if (schema == SchemaState::kEmpty) {
    DHPMAP_RETURN_IF_ERROR(database.Execute("PRAGMA page_size = 4096", kSetUpTask));
    DHPMAP_RETURN_IF_ERROR(sqlite::AllowGivingBack(database));
  }
  DHPMAP_RETURN_IF_ERROR(SwitchToLog(database));
  DHPMAP_RETURN_IF_ERROR(database.Execute(kEveryConnection, kSetUpTask));
  DHPMAP_RETURN_IF_ERROR(database.Execute(kWriterConnection, kSetUpTask));
  if (schema == SchemaState::kOlder) DHPMAP_RETURN_IF_ERROR(KeepUpgradeCopy(database, path, copy));
  if (schema != SchemaState::kCurrent) DHPMAP_RETURN_IF_ERROR(MigrateSchema(database, ReleasedSteps(), copy.progress));
  return database;
}

Result<Database> OpenForLog(const std::string& path) {
  constexpr int kBusyTimeout_ms = 0;
  DHPMAP_ASSIGN_OR_RETURN(Database database, Database::Open(path, OpenMode::kReadWrite, kBusyTimeout_ms));
  database.SetCheckpointOnClose(false);
  DHPMAP_RETURN_IF_ERROR(database.Execute(kEveryConnection, kSetUpTask));
  DHPMAP_RETURN_IF_ERROR(database.Execute("PRAGMA synchronous = NORMAL", kSetUpTask));
  return database;
}

Result<OpenMode> ProbeReadOnly(const std::string& path, int busy_timeout_ms) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return NotFound("there is no database file").WithReason("NO_DATABASE");
  }
  DHPMAP_RETURN_IF_ERROR(CheckIsFile(path));
  OpenMode mode = OpenMode::kReadOnly;
  const auto inspect = [&]() -> Result<SchemaState> {
    DHPMAP_ASSIGN_OR_RETURN(Database database, OpenReader(path, mode, busy_timeout_ms));
    return InspectSchema(database);
  };
  Result<SchemaState> schema = inspect();
  // In a read-only folder SQLite cannot create the index of a write-ahead log; without a log it is not needed.
  if (schema.status().code() == StatusCode::kFailedPrecondition && schema.status().reason().empty() && !HasLog(path)) {
    mode = OpenMode::kReadOnlyImmutable;
    schema = inspect();
  }
  if (!schema.ok()) return schema.status();
  if (*schema == SchemaState::kCurrent) return mode;
  return FailedPrecondition("the database has to be opened for writing once, to bring it up to date")
      .WithReason("OLDER_SCHEMA");
}

Result<ReaderPool::Lease> ReaderPool::Borrow() {
  {
    const MutexLock lock(mutex_);
    if (!idle_.empty()) {
      Database database = std::move(idle_.back());
      idle_.pop_back();
      return Lease(*this, std::move(database));
    }
  }
  DHPMAP_ASSIGN_OR_RETURN(Database database, OpenReader(path_, mode_, busy_timeout_ms_));
  return Lease(*this, std::move(database));
}

void ReaderPool::Return(Database database) {
  // Up to 16 MiB each; the allocator also keeps whole slabs for pages mixed with data that were read.
  database.ReleaseMemory();
  const MutexLock lock(mutex_);
  if (idle_.size() < kMaxIdleReaders) idle_.push_back(std::move(database));
}

}  // namespace dhpmap
