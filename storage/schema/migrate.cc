// SPDX-License-Identifier: BSD-3-Clause
#include "storage/schema/migrate.h"

#include <string>
#include <vector>

#include "storage/sqlite/transaction.h"

namespace dhpmap {
namespace {

constexpr char kReadVersionTask[] = "read the database's version";

Status NotOurs() {
  return FailedPrecondition("the database file belongs to another application").WithReason("FOREIGN_DATABASE");
}

/// About 20 MB.
constexpr std::int64_t kPartsATransaction = 4096;

struct SchemaObject {
  std::string type, name, sql;
};

/// Migrates a database from schema `number` to the next.
Status Do(const SchemaStep& step, std::int64_t number, sqlite::Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Transaction transaction, sqlite::Transaction::BeginWrite(database));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t version, database.QueryInt("PRAGMA user_version", kReadVersionTask));
  if (version != number) return Aborted("another process brings the database up to date");
  DHPMAP_RETURN_IF_ERROR(database.Execute(step.sql, "bring the database up to date"));
  if (step.run != nullptr) DHPMAP_RETURN_IF_ERROR(step.run(database));
  DHPMAP_RETURN_IF_ERROR(database.Execute("PRAGMA application_id = " + std::to_string(kApplicationId) +
                                              "; PRAGMA user_version = " + std::to_string(number + 1),
                                          "mark the database as ours"));
  return transaction.Commit();
}

/// Completes the remaining work of a step, part by part.
Status DoWork(const SchemaWork& work, sqlite::Database& database, const SchemaProgress& progress) {
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool is_left, work.is_left(database));
    if (!is_left) return Status::Ok();
    DHPMAP_ASSIGN_OR_RETURN(sqlite::Transaction transaction, sqlite::Transaction::BeginWrite(database));
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_left, work.do_some(database, kPartsATransaction));
    DHPMAP_RETURN_IF_ERROR(transaction.Commit());
    if (num_left > 0 && progress) {
      progress("bringing the database up to date: " + std::to_string(num_left) + " " + work.unit + " left");
    }
  }
}

/// Whether a completed step has work left.
Result<bool> HasWorkLeft(SchemaSteps done, sqlite::Database& database) {
  for (const SchemaStep& step : done) {
    if (step.work == nullptr) continue;
    DHPMAP_ASSIGN_OR_RETURN(const bool is_left, step.work->is_left(database));
    if (is_left) return true;
  }
  return false;
}

/// The schema objects of an empty database after all steps.
Result<std::vector<SchemaObject>> ReferenceObjects(SchemaSteps steps) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Database reference, sqlite::Database::OpenInMemory());
  DHPMAP_RETURN_IF_ERROR(MigrateSchema(reference, steps));
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement select,
                          reference.Prepare("SELECT type, name, ifnull(sql, '') FROM sqlite_schema", kReadVersionTask));
  std::vector<SchemaObject> objects;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return objects;
    objects.push_back({select.Text(0), select.Text(1), select.Text(2)});
  }
}

/// DATA_LOSS unless every table, index and trigger of our schema exists. Additional ones of an operator are permitted.
Status CheckObjects(sqlite::Database& database, const Result<std::vector<SchemaObject>>& reference) {
  if (!reference.ok()) return reference.status();
  DHPMAP_ASSIGN_OR_RETURN(
      sqlite::Statement find,
      database.Prepare("SELECT count(*) FROM sqlite_schema WHERE type = ? AND name = ? AND ifnull(sql, '') = ?",
                       kReadVersionTask));
  for (const SchemaObject& object : *reference) {
    DHPMAP_ASSIGN_OR_RETURN(const bool counted, find.Bind(object.type).Bind(object.name).Bind(object.sql).Step());
    if (!counted || find.Int(0) != 1) {
      return DataLoss("the database lacks a part of its schema").WithReason("BAD_SCHEMA");
    }
    find.Reset();
  }
  return Status::Ok();
}

}  // namespace

Result<SchemaState> InspectSchema(sqlite::Database& database, SchemaSteps steps) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t application_id,
                          database.QueryInt("PRAGMA application_id", kReadVersionTask));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t version, database.QueryInt("PRAGMA user_version", kReadVersionTask));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_objects,
                          database.QueryInt("SELECT count(*) FROM sqlite_schema", kReadVersionTask));
  if (application_id == 0 && version == 0 && num_objects == 0) return SchemaState::kEmpty;
  if (application_id != kApplicationId) return NotOurs();
  if (version > VersionOf(steps)) {
    return FailedPrecondition("the database is of schema " + std::to_string(version) +
                              ", dhpmap " DHPMAP_VERSION " knows schemas up to " + std::to_string(VersionOf(steps)))
        .WithReason("NEWER_SCHEMA");
  }
  if (version < 1) return DataLoss("the database's schema version " + std::to_string(version) + " cannot be right");
  const SchemaSteps done = steps.first(static_cast<std::size_t>(version));
  if (steps.data() == ReleasedSteps().data() && done.size() == steps.size()) {
    static const Result<std::vector<SchemaObject>> present = ReferenceObjects(ReleasedSteps());
    DHPMAP_RETURN_IF_ERROR(CheckObjects(database, present));
  } else {
    DHPMAP_RETURN_IF_ERROR(CheckObjects(database, ReferenceObjects(done)));
  }
  DHPMAP_ASSIGN_OR_RETURN(const bool has_work_left, HasWorkLeft(done, database));
  return version < VersionOf(steps) || has_work_left ? SchemaState::kOlder : SchemaState::kCurrent;
}

Status CheckNothingElse(sqlite::Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t version, database.QueryInt("PRAGMA user_version", kReadVersionTask));
  if (version < 1 || version > SchemaVersion()) return Internal("the schema was not looked at");
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<SchemaObject> ours,
                          ReferenceObjects(ReleasedSteps().first(static_cast<std::size_t>(version))));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_objects,
                          database.QueryInt("SELECT count(*) FROM sqlite_schema", kReadVersionTask));
  if (num_objects == static_cast<std::int64_t>(ours.size())) return Status::Ok();
  return DataLoss("the database has more than our schema").WithReason("BAD_SCHEMA");
}

Status MigrateSchema(sqlite::Database& database, SchemaSteps steps, const SchemaProgress& progress) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t version, database.QueryInt("PRAGMA user_version", kReadVersionTask));
  for (std::int64_t number = 0; number < VersionOf(steps); ++number) {
    const SchemaStep& step = steps[static_cast<std::size_t>(number)];
    if (number >= version) DHPMAP_RETURN_IF_ERROR(Do(step, number, database));
    if (step.work != nullptr) DHPMAP_RETURN_IF_ERROR(DoWork(*step.work, database, progress));
  }
  return Status::Ok();
}

}  // namespace dhpmap
