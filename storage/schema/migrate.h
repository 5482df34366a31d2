// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/base/result.h"
#include "storage/schema/steps.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// PRAGMA application_id of our files: "dhpM".
inline constexpr std::int64_t kApplicationId = 0x6468704D;

enum class SchemaState { kEmpty, kOlder, kCurrent };

/// Looks, without writing, for what `steps` make. DATA_LOSS: not a database, or damaged. FAILED_PRECONDITION: another
/// application's, or newer.
Result<SchemaState> InspectSchema(sqlite::Database& database, SchemaSteps steps = ReleasedSteps());

/// Does the steps that an empty or older database lacks, each in one transaction: after a failure or a crash it is of
/// the schema of the last step that was done, and the next call goes on from there.
Status MigrateSchema(sqlite::Database& database, SchemaSteps steps = ReleasedSteps());

}  // namespace dhpmap
