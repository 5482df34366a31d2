// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "mapping/base/result.h"
#include "storage/schema/steps.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// PRAGMA application_id of our files: "dhpM".
inline constexpr std::int64_t kApplicationId = 0x6468704D;

enum class SchemaState { kEmpty, kOlder, kCurrent };

/// Compares the database with `steps`, read-only. DATA_LOSS: not a database, or damaged. FAILED_PRECONDITION: of
/// another application, or newer.
Result<SchemaState> InspectSchema(sqlite::Database& database, SchemaSteps steps = ReleasedSteps());

/// DATA_LOSS, reason BAD_SCHEMA, if a database that InspectSchema accepts has foreign tables, triggers or views.
Status CheckNothingElse(sqlite::Database& database);

/// Reports long work, in a sentence for the operator's log.
using SchemaProgress = std::function<void(const std::string& message)>;

/// Runs the missing steps, each in one transaction, and after each its work, in several transactions: after a failure
/// or crash the next call continues.
Status MigrateSchema(sqlite::Database& database, SchemaSteps steps = ReleasedSteps(),
                     const SchemaProgress& progress = {});

}  // namespace dhpmap
