// SPDX-License-Identifier: BSD-3-Clause
#include "storage/schema/migrate.h"

#include <string>

#include "storage/sqlite/transaction.h"

namespace dhpmap {
namespace {

constexpr char kTask[] = "read the database's version";

Status NotOurs() {
  return FailedPrecondition("the database file belongs to another application").WithReason("FOREIGN_DATABASE");
}

}  // namespace

Result<SchemaState> InspectSchema(sqlite::Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t application_id, database.QueryInt("PRAGMA application_id", kTask));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t version, database.QueryInt("PRAGMA user_version", kTask));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_objects,
                          database.QueryInt("SELECT count(*) FROM sqlite_schema", kTask));
  if (application_id == 0 && version == 0 && num_objects == 0) return SchemaState::kEmpty;
  if (application_id != kApplicationId) return NotOurs();
  if (version > SchemaVersion()) {
    return FailedPrecondition("the database is of schema " + std::to_string(version) + ", this version knows " +
                              std::to_string(SchemaVersion()))
        .WithReason("NEWER_SCHEMA");
  }
  if (version < 1) return DataLoss("the database's schema version " + std::to_string(version) + " cannot be right");
  return version < SchemaVersion() ? SchemaState::kOlder : SchemaState::kCurrent;
}

Status MigrateSchema(sqlite::Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Transaction transaction, sqlite::Transaction::BeginWrite(database));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t version, database.QueryInt("PRAGMA user_version", kTask));
  for (std::int64_t step = version; step < SchemaVersion(); ++step) {
    DHPMAP_RETURN_IF_ERROR(
        database.Execute(SchemaSteps()[static_cast<std::size_t>(step)], "bring the database up to date"));
  }
  DHPMAP_RETURN_IF_ERROR(database.Execute("PRAGMA application_id = " + std::to_string(kApplicationId) +
                                              "; PRAGMA user_version = " + std::to_string(SchemaVersion()),
                                          "mark the database as ours"));
  return transaction.Commit();
}

}  // namespace dhpmap
