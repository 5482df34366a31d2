// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Work of a step that is too large for one transaction; resumable.
struct SchemaWork {
  /// Whether any work is left; read-only.
  Result<bool> (*is_left)(sqlite::Database& database);
  /// Does up to `max_parts` of it, some kB each, within the caller's transaction. Returns the amount left, 0 at the
  /// end.
  Result<std::int64_t> (*do_some)(sqlite::Database& database, std::int64_t max_parts);
  const char* unit;  ///< unit of the amount, for messages
};

/// Migrates a database from one schema to the next: SQL, then code if SQL is not enough. Runs in its own transaction.
/// Frozen once released, so code names tables and columns as of that step, not by the lists in rows/. Also runs on an
/// empty database, and must not end or begin a transaction.
struct SchemaStep {
  const char* sql = "";
  Status (*run)(sqlite::Database& database) = nullptr;  ///< null: none
  const SchemaWork* work = nullptr;                     ///< afterwards, before the next step; null: none
};
using SchemaSteps = std::span<const SchemaStep>;

}  // namespace dhpmap
