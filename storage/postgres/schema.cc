// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/schema.h"

namespace dhpmap::postgres {
namespace {

constexpr char kSchemaTask[] = "bring the database up to date";
const std::string kReadVersion = "SELECT coalesce(max(step), 0) FROM schema_steps";

Result<std::int64_t> ReadVersion(Connection& connection) {
  DHPMAP_ASSIGN_OR_RETURN(Answer version, connection.Query({&kReadVersion}, kSchemaTask));
  return version.Next() ? version.Int() : 0;
}

}  // namespace

Status PrepareSchema(Connection& connection, const std::string& schema,
                     const std::function<void(const std::string& message)>& on_progress) {
  // Of servers that start at once one makes each step, and the others fail at it and find it made.
  const std::string begin =
      "CREATE SCHEMA IF NOT EXISTS " + schema + "; CREATE TABLE IF NOT EXISTS schema_steps (step bigint PRIMARY KEY)";
  if (!connection.Execute(begin, kSchemaTask).ok()) DHPMAP_RETURN_IF_ERROR(connection.Execute(begin, kSchemaTask));
  DHPMAP_ASSIGN_OR_RETURN(std::int64_t done, ReadVersion(connection));
  const auto texts = SchemaTexts();
  const auto newest = static_cast<std::int64_t>(texts.size());
  if (done > newest) {
    return FailedPrecondition("the database is of schema " + std::to_string(done) + ", this version knows up to " +
                              std::to_string(newest))
        .WithReason("NEWER_SCHEMA");
  }
  while (done < newest) {
    const std::string text = texts[static_cast<std::size_t>(done++)];
    if (on_progress) on_progress("bringing the database to schema " + std::to_string(done));
    // One text is one transaction.
    Status made = connection.Execute(text + "; INSERT INTO schema_steps (step) VALUES (" + std::to_string(done) + ")",
                                     kSchemaTask);
    if (made.ok()) continue;
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t present, ReadVersion(connection));
    if (present < done) return made;
  }
  return Status::Ok();
}

}  // namespace dhpmap::postgres
