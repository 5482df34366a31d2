// SPDX-License-Identifier: BSD-3-Clause
#include "storage/sqlite/free_pages.h"

#include <string>

namespace dhpmap::sqlite {
namespace {

constexpr char kGiveBackTask[] = "give free space back";
constexpr std::int64_t kIncremental = 2;

/// SQLite returns whether it was blocked, the frames in the log, and the number of copied frames.
Result<LogState> Checkpoint(Database& database, const char* pragma) {
  DHPMAP_ASSIGN_OR_RETURN(Statement statement, database.Prepare(pragma, kGiveBackTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, statement.Step());
  if (!has_row) return Internal("copying the log gave no answer");
  return statement.Int(0) == 0 && statement.Int(1) == statement.Int(2) ? LogState::kEmptied : LogState::kInUse;
}

}  // namespace

Status AllowGivingBack(Database& database) {
  return database.Execute("PRAGMA auto_vacuum = INCREMENTAL", kGiveBackTask);
}

Result<bool> AllowsGivingBack(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t mode, database.QueryInt("PRAGMA auto_vacuum", kGiveBackTask));
  return mode == kIncremental;
}

Result<std::int64_t> NumFreePages(Database& database) {
  return database.QueryInt("PRAGMA freelist_count", kGiveBackTask);
}

Status GiveBackPages(Database& database, std::int64_t num_pages) {
  return database.Execute("PRAGMA incremental_vacuum(" + std::to_string(num_pages) + ")", kGiveBackTask);
}

Result<LogState> CopyLog(Database& database) { return Checkpoint(database, "PRAGMA wal_checkpoint(PASSIVE)"); }

Result<LogState> CutLog(Database& database) { return Checkpoint(database, "PRAGMA wal_checkpoint(TRUNCATE)"); }

}  // namespace dhpmap::sqlite
