// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/auth/key_rows.h"

#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/transaction_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadKeysTask[] = "read the keys";
constexpr char kWriteKeysTask[] = "write the keys";
const std::string kKeysVersion = "SELECT version FROM auth_versions WHERE name = 'keys'";
const std::string kKeyRows = "SELECT id, record FROM auth_keys ORDER BY id LIMIT $1";
// Fails (see IsFenced) if the keys have changed since.
const std::string kRaiseKeysVersion =
    "WITH raised AS (UPDATE auth_versions SET version = version + 1 WHERE name = 'keys' AND version = $1 RETURNING 1) "
    "SELECT 1 / count(*) FROM raised";
const std::string kPutKey =
    "INSERT INTO auth_keys (id, record) VALUES ($1, $2) ON CONFLICT (id) DO UPDATE SET record = excluded.record";

}  // namespace

Result<std::int64_t> ReadKeysVersion(Connection& connection) {
  DHPMAP_ASSIGN_OR_RETURN(Answer version, connection.Query({&kKeysVersion}, kReadKeysTask));
  return version.Next() ? version.Int() : 0;
}

Result<KeyRows> ReadKeyRows(Connection& connection) {
  std::vector<Call> calls = {{&kKeysVersion}, {&kKeyRows}};  // the version first: then the rows are at least as new
  calls[1].values.Add(AuthTables::kMostKeys + 1);
  Answers done = connection.Run(calls, kReadKeysTask);
  if (!done.status.ok()) return done.status;
  KeyRows keys;
  if (done.answers[0].Next()) keys.version = done.answers[0].Int();
  Answer& answer = done.answers[1];
  if (answer.num_rows() > AuthTables::kMostKeys) return ResourceExhausted("there are more than 10000 keys");
  while (answer.Next()) {
    KeyRow& row = keys.rows.emplace_back();
    row.id = answer.Text();
    row.record = answer.Text();
  }
  return keys;
}

Status WriteKeyRows(Connection& connection, std::int64_t seen_version, std::span<const KeyRow> changed) {
  std::vector<Call> calls = {{&BeginText()}, {&kRaiseKeysVersion}};
  calls[1].values.Add(seen_version);
  for (const KeyRow& row : changed) calls.emplace_back(Call{&kPutKey}).values.Add(row.id).Add(row.record);
  calls.push_back({&CommitText()});
  const Answers done = connection.Run(calls, kWriteKeysTask);
  if (IsFenced(done.sqlstate)) return {StatusCode::kAborted, "somebody else has changed the keys meanwhile"};
  if (done.outcome != Outcome::kUnknown) return done.status;
  return Unavailable("the database was lost while it stored the keys: look whether it has");
}

}  // namespace dhpmap::postgres
