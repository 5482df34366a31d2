// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "storage/store.h"

namespace dhpmap {

struct PostgresStoreOptions {
  std::string schema = "dhpmap";  ///< of its tables: letters, digits and _
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  /// Blobs that nobody refers to any more stay so long, by the time that servers have the map open.
  double dead_grace_s = 600;
  int max_connections = 8;
  /// For an answer of the database; and, if it was lost, for learning what became of a commit.
  double answer_s = 30;
  /// Reports the progress of migrations while opening; may be empty.
  std::function<void(const std::string& message)> on_progress = {};
  /// Clock of the ages of kept data, in ns; empty: std::chrono::steady_clock.
  std::function<std::int64_t()> passing_time_ns = {};
};

/// Opens or creates a store in a PostgreSQL database (14 or later). `url`: postgresql://..., as libpq takes it; it is
/// in no message. UNAVAILABLE if the database does not answer; FAILED_PRECONDITION, reason NEWER_SCHEMA, or without
/// rights.
///
/// One process for each database: one that opens a map takes it from another, whose commits are then refused
/// FAILED_PRECONDITION, reason DATABASE_IN_USE. Both durabilities are full. Not there yet, answered UNIMPLEMENTED:
/// VerifyMap, ExportMap, ImportMap. Backup: NOT_A_FILE.
Result<std::unique_ptr<MapStore>> OpenPostgresStore(const std::string& url, const PostgresStoreOptions& options = {});

/// Whether a database is named by a URL of PostgreSQL, and not as a file.
bool IsPostgresUrl(const std::string& db);

}  // namespace dhpmap
