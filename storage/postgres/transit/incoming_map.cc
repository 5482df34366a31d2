// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/transit/incoming_map.h"

#include <string>
#include <vector>

#include "mapping/map/history_id.h"
#include "storage/postgres/postgres_error.h"
#include "storage/postgres/transaction_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kImportTask[] = "import the map";
const std::string kExpectMap = "INSERT INTO incoming_maps (map_key) VALUES ($1) ON CONFLICT DO NOTHING";
// The lock is held while the file is read; the connection's usual limit is meant for commits.
const std::string kHoldForLong = "SELECT set_config('idle_in_transaction_session_timeout', '0', true)";
const std::string kLockIncoming = "SELECT map_key FROM incoming_maps WHERE map_key = $1 FOR UPDATE";
const std::string kArrive =
    "WITH arrived AS (DELETE FROM incoming_maps WHERE map_key = $1 RETURNING 1) SELECT 1 / count(*) FROM arrived";
const std::string kGiveUp =
    "WITH gone AS (DELETE FROM incoming_maps WHERE map_key IN (SELECT i.map_key FROM incoming_maps i FOR UPDATE SKIP "
    "LOCKED) RETURNING map_key) INSERT INTO removed_maps (map_key) SELECT map_key FROM gone";
const std::string kIsMapThere = "SELECT 1 FROM maps WHERE map_key = $1";

Call CallWith(const std::string& text, std::int64_t map_key) {
  Call call{&text};
  call.values.Add(map_key);
  return call;
}

}  // namespace

Result<IncomingMap> IncomingMap::Begin(const ConnectionOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(Connection connection, Connection::Open(options));
  const auto key = static_cast<std::int64_t>(DrawHistoryId());
  constexpr int kMostTries = 8;  // a sweeper may come between the row and its lock
  for (int n = 0; n < kMostTries; ++n) {
    DHPMAP_RETURN_IF_ERROR(connection.Query(CallWith(kExpectMap, key), kImportTask).status());
    const std::vector<Call> hold = {{&BeginText()}, {&kHoldForLong}, CallWith(kLockIncoming, key)};
    const Answers held = connection.Run(hold, kImportTask);
    if (!held.status.ok()) return held.status;
    if (held.answers.back().num_rows() == 1) return IncomingMap(std::move(connection), key);
    DHPMAP_RETURN_IF_ERROR(connection.Execute("ROLLBACK", kImportTask));
  }
  return ConnectionLost(kImportTask, "others sweep what it begins");
}

/// Releases the lock at once; the database would notice the closed connection only a moment later.
IncomingMap::~IncomingMap() {
  if (!connection_.IsBroken()) (void)connection_.Execute("ROLLBACK", kImportTask);
}

Answers IncomingMap::Finish(std::span<const Call> calls) {
  std::vector<Call> all = {CallWith(kArrive, key_)};
  all.insert(all.end(), calls.begin(), calls.end());
  all.push_back({&CommitText()});
  return connection_.Run(all, kImportTask);
}

Result<std::int64_t> GiveUpAbandoned(Connection& connection) {
  DHPMAP_ASSIGN_OR_RETURN(const Answer given_up, connection.Query({&kGiveUp}, kImportTask));
  return given_up.NumChanged();
}

Result<bool> HasArrived(Connection& connection, std::int64_t map_key) {
  // The backend of the lost commit holds the first row until it ends; the second row shows the outcome.
  const std::vector<Call> calls = {CallWith(kLockIncoming, map_key), CallWith(kIsMapThere, map_key)};
  const Answers asked = connection.Run(calls, "ask what became of an import");
  if (!asked.status.ok()) return asked.status;
  if (asked.has_warning) return ConnectionLost("ask what became of an import", "no standby has answered");
  return asked.answers.back().num_rows() > 0;
}

}  // namespace dhpmap::postgres
