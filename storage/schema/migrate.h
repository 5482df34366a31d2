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

/// Looks, without writing, for what `steps` make. DATA_LOSS: not a database, or damaged. FAILED_PRECONDITION: another
/// application's, or newer.
Result<SchemaState> InspectSchema(sqlite::Database& database, SchemaSteps steps = ReleasedSteps());

/// DATA_LOSS, reason BAD_SCHEMA, if a database that InspectSchema has accepted holds tables, triggers or views beside
/// ours.
Status CheckNothingElse(sqlite::Database& database);

/// Hears of work that takes long: what it is at, in words for an operator's log.
using SchemaProgress = std::function<void(const std::string& message)>;

/// Does the steps that an empty or older database lacks, each in one transaction, and after each its work, in as many
/// as that needs: after a failure or a crash the next call goes on from there.
Status MigrateSchema(sqlite::Database& database, SchemaSteps steps = ReleasedSteps(),
                     const SchemaProgress& progress = {});

}  // namespace dhpmap
