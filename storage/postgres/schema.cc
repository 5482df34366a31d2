// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/schema.h"

namespace dhpmap::postgres {
namespace {

constexpr char kSchemaTask[] = "bring the database up to date";
const std::string kReadStep = "SELECT coalesce(max(step), 0) FROM schema_steps";

Result<std::int64_t> ReadStep(Connection& connection) {
  DHPMAP_ASSIGN_OR_RETURN(Answer step, connection.Query({&kReadStep}, kSchemaTask));
  return step.Next() ? step.Int() : 0;
}

}  // namespace

void Schema::Raise(std::int64_t step) {
  std::int64_t before = in_force_;
  while (before < step && !in_force_.compare_exchange_weak(before, step)) {
  }
}

Status NewerSchema(std::int64_t in_force, std::int64_t newest) {
  return FailedPrecondition("the database is of schema " + std::to_string(in_force) + ", this version knows up to " +
                            std::to_string(newest) + ": start a newer version")
      .WithReason("NEWER_SCHEMA");
}

Result<std::int64_t> ReadSchema(Connection& connection, const std::string& schema) {
  // Of servers that start at once one makes it, and the others fail at it and find it made.
  const std::string begin =
      "CREATE SCHEMA IF NOT EXISTS " + schema + "; CREATE TABLE IF NOT EXISTS schema_steps (step bigint PRIMARY KEY)";
  if (!connection.Execute(begin, kSchemaTask).ok()) DHPMAP_RETURN_IF_ERROR(connection.Execute(begin, kSchemaTask));
  return ReadStep(connection);
}

Status MakeSteps(Connection& connection, const Schema& schema, std::int64_t from, const std::string& check) {
  // The first statement waits for a process that makes the same steps. From then on no lock is waited for longer than
  // the servers' beats may wait behind it.
  std::string numbers, texts;
  for (const SchemaStep& step : schema.steps()) {
    if (step.number <= from) continue;
    numbers += (numbers.empty() ? "(" : ", (") + std::to_string(step.number) + ")";
    texts += step.sql + ";\n";
  }
  if (numbers.empty()) return Status::Ok();
  // One text is one transaction.
  const std::string text = "INSERT INTO schema_steps (step) VALUES " + numbers +
                           "; SELECT set_config('lock_timeout', '1000', true);\n" + texts + check;
  Status made = connection.Execute(text, kSchemaTask);
  if (made.ok()) return made;
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t present, ReadStep(connection));
  return present >= schema.newest() ? Status::Ok() : made;
}

}  // namespace dhpmap::postgres
