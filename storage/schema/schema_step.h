// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// What a step leaves to do that is too much for one transaction. It goes on where it was, however it ended.
struct SchemaWork {
  /// Looks whether anything is left, without writing.
  Result<bool> (*is_left)(sqlite::Database& database);
  /// Up to `max_parts` of it, each of some kB, within the caller's transaction. Returns how much is left, 0 when it is
  /// done.
  Result<std::int64_t> (*do_some)(sqlite::Database& database, std::int64_t max_parts);
  const char* unit;  ///< what is counted, for messages
};

/// What brings a database from one schema to the next: SQL, then code for what SQL cannot say. Runs in a transaction of
/// its own. Never changed once released, so code names tables and columns as they are at that step, not by the lists in
/// rows/. It also runs on an empty database, and must not end or begin a transaction.
struct SchemaStep {
  const char* sql = "";
  Status (*run)(sqlite::Database& database) = nullptr;  ///< null: nothing more
  const SchemaWork* work = nullptr;                     ///< after that, before the next step; null: none
};
using SchemaSteps = std::span<const SchemaStep>;

}  // namespace dhpmap
