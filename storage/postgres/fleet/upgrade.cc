// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/fleet/upgrade.h"

#include <algorithm>
#include <optional>

#include "storage/postgres/fleet/fleet_rows.h"

namespace dhpmap::postgres {
namespace {

constexpr char kOpenTask[] = "look for other servers";
constexpr std::int64_t kServersStep = 2;  // makes the table of servers

/// Added before the step that needs it. Without it a server counts as one of kOldestSchema.
const std::string kAddKnownSchema =
    "SET lock_timeout TO 1000; ALTER TABLE servers ADD COLUMN IF NOT EXISTS knows_schema bigint NOT NULL DEFAULT 4; "
    "RESET lock_timeout";

/// Every later beat of an older server violates the constraint. The division fails if an older server outside `dead`
/// has beaten; none can beat before the transaction ends.
std::string ForbidOlderServers(std::int64_t newest, std::span<const ServerRow> dead) {
  std::string text =
      "ALTER TABLE servers DROP CONSTRAINT IF EXISTS servers_know_schema; ALTER TABLE servers ADD CONSTRAINT "
      "servers_know_schema CHECK (knows_schema >= " +
      std::to_string(newest) + ") NOT VALID; SELECT 1 / (1 - least(count(*), 1)) FROM servers WHERE knows_schema < " +
      std::to_string(newest);
  for (const ServerRow& row : dead) {
    text += " AND (server, beat) <> (" + std::to_string(row.server) + ", " + std::to_string(row.beat) + ")";
  }
  return text;
}

/// A server that has beaten, or joined, between two reads.
std::optional<ServerRow> FindBeating(std::span<const ServerRow> before, std::span<const ServerRow> after) {
  for (const ServerRow& row : after) {
    const auto seen =
        std::find_if(before.begin(), before.end(), [&](const ServerRow& b) { return b.server == row.server; });
    if (seen == before.end() || seen->beat != row.beat) return row;
  }
  return std::nullopt;
}

}  // namespace

std::string DescribeServer(const ServerRow& server) {
  return (server.address.empty() ? "servers/" + std::to_string(server.server) : server.address) + " (version " +
         server.version + ", schema " + std::to_string(server.knows_schema) + ")";
}

Status Upgrade(Connection& connection, Schema& schema, std::span<const ServerRow> dead) {
  Status made = MakeSteps(connection, schema, schema.in_force(), ForbidOlderServers(schema.newest(), dead));
  if (made.code() == StatusCode::kInvalidArgument) {  // the division
    return Unavailable("a server of an older version beats meanwhile: the database stays at schema " +
                       std::to_string(schema.in_force()));
  }
  if (made.ok()) schema.Raise(schema.newest());
  return made;
}

Status OpenSchema(Connection& connection, Schema& schema, const SchemaOpening& opening) {
  const auto tell = [&](const std::string& message) {
    if (opening.on_progress) opening.on_progress(message);
  };
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t found, ReadSchema(connection, opening.schema));
  if (found > schema.newest()) return NewerSchema(found, schema.newest());
  schema.Raise(found);
  if (found == schema.newest()) return Status::Ok();

  std::vector<ServerRow> rows;
  if (found >= kServersStep) {
    DHPMAP_RETURN_IF_ERROR(connection.Execute(kAddKnownSchema, kOpenTask));
    DHPMAP_ASSIGN_OR_RETURN(rows, ReadRows(connection));
  }
  if (!rows.empty()) {
    tell("the database is of schema " + std::to_string(found) + ": looking whether other servers use it");
    opening.pause();
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<ServerRow> later, ReadRows(connection));
    if (const auto living = FindBeating(rows, later)) {
      if (found < kOldestSchema) {
        return FailedPrecondition("the database is of schema " + std::to_string(found) + ", and in use by " +
                                  DescribeServer(*living) + ": this version goes back to " +
                                  std::to_string(kOldestSchema));
      }
      tell("the database stays at schema " + std::to_string(found) + " beside " + DescribeServer(*living) +
           ", until `dhpmap fleet upgrade finish`");
      return Status::Ok();
    }
  }
  tell("bringing the database to schema " + std::to_string(schema.newest()));
  return Upgrade(connection, schema, rows);
}

}  // namespace dhpmap::postgres
