// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "storage/store.h"

namespace dhpmap {

struct SqliteStoreOptions {
  bool read_only = false;
  int busy_timeout_ms = 5000;
  /// Reports the progress of migrations while opening, also from another thread; may be empty.
  std::function<void(const std::string& message)> on_progress;
  /// Before a migration, keeps the database as it is in a file beside it, "maps.db.before-v15" before schema 15.
  bool keeps_copy_before_migration = false;
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  /// LoadMap leaves the voxels of objects on disk until they are requested (BlockTile). Maps of schema 10 and before
  /// are read once for this. Reading a state throws StatusError if the disk fails: DATA_LOSS, UNAVAILABLE once the
  /// store is closed, or SQLite's error. Separately loaded states of one map are independent: data that commits from
  /// one have replaced, and that the other has not read, give ABORTED, reason SNAPSHOT_EXPIRED.
  bool pages_tiles = false;
  /// Clock of the ages of kept data, in ns; empty: std::chrono::steady_clock.
  std::function<std::int64_t()> passing_time_ns = {};
};

/// Opens or creates a database file. DATA_LOSS if it is damaged or no database; FAILED_PRECONDITION, by reason:
/// FOREIGN_DATABASE (other application_id), NEWER_SCHEMA, NOT_WRITABLE, NOT_A_FILE, DATABASE_IN_USE (another store, of
/// this or another process, writes to it; names the process), and without a reason if there is no room for the copy
/// before a migration. NOT_FOUND if its folder does not exist. With read_only,
/// which works next to a writer: NOT_FOUND if there is no file, reason OLDER_SCHEMA if it must be migrated first.
Result<std::unique_ptr<MapStore>> OpenSqliteStore(const std::string& path, const SqliteStoreOptions& options = {});

/// What a store would meet at a database file.
struct DatabaseLook {
  bool is_there = false;
  std::string holder;              ///< who has it open for writing: "process 123"; then nothing below is known
  std::int64_t schema = 0;         ///< 0: empty
  std::int64_t server_schema = 0;  ///< that this version would bring it to
  std::int64_t copy_bytes = 0;     ///< a copy before the migration takes at most; 0: none is due
  std::int64_t free_bytes = 0;     ///< of the disk
  bool has_room_for_copy = true;
  std::string copy_path;  ///< where it would be
};

/// Reads only, and changes nothing. Errors as of OpenSqliteStore.
Result<DatabaseLook> LookAtDatabase(const std::string& path);

/// Memory of SQLite over all stores of the process. Thread-safe.
std::int64_t SqliteMemoryBytes();

}  // namespace dhpmap
