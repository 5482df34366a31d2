// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// PRAGMA application_id of our files: "dhpM".
inline constexpr std::int64_t kApplicationId = 0x6468704D;

/// The numbered .sql files of this folder, in order: entry i brings a database from schema i to i + 1.
std::span<const char* const> SchemaSteps();
inline std::int64_t SchemaVersion() { return static_cast<std::int64_t>(SchemaSteps().size()); }

enum class SchemaState { kEmpty, kOlder, kCurrent };

/// Looks, without writing. DATA_LOSS: not a database, or damaged. FAILED_PRECONDITION: another application's, or newer.
Result<SchemaState> InspectSchema(sqlite::Database& database);

/// Brings an empty or older database to the present schema, all or nothing.
Status MigrateSchema(sqlite::Database& database);

}  // namespace dhpmap
