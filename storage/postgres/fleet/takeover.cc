// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/fleet/takeover.h"

#include <vector>

#include "storage/postgres/transaction_text.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

constexpr char kTakeTask[] = "take the map";
const std::string kWaitBriefly = "SELECT set_config('lock_timeout', '500', true)";
// Locks the owner's row until the map is taken. So the owner's next beat comes later, and it then finds its loss.
const std::string kIsStillDead =
    "WITH held AS (SELECT beat FROM servers WHERE server = $1 FOR UPDATE) SELECT 1 / (1 - count(*)) FROM held WHERE "
    "beat <> $2";
const std::string kNoteLost = "INSERT INTO lost_revisions (map_key, first_revision, last_revision) VALUES ($1, $2, $3)";
const std::string kEndConnections =
    "SELECT pg_terminate_backend(pid, 1000) FROM pg_stat_activity WHERE application_name = $1 AND usename = "
    "current_user";

/// A damaged row keeps its checksum: with a new one it would pass as whole.
MapHead HeadOfNewOwner(const MapHead& seen, std::int64_t server, bool is_damaged) {
  MapHead head = seen;
  ++head.commit_id;
  ++head.owner_epoch;
  head.owner = server;
  MapRow& row = head.row;
  if (HasReservedNumbers(row) && !is_damaged) {
    RaiseMarks(row);
    row.info.revision = row.marks.revision + 1;
    row.info.next_submap_id = row.marks.next_submap_id;
    RaiseMarks(row);
    SealMapRow(row);
  }
  return head;
}

}  // namespace

std::string ApplicationName(std::int64_t server) { return "dhpmap-server-" + std::to_string(server); }

Result<Taken> Take(Connection& connection, const Taking& taking) {
  const MapHead& seen = taking.seen;
  const MapHead after = HeadOfNewOwner(seen, taking.server, taking.is_damaged);
  std::vector<Call> calls = {{&BeginText()}, {&kWaitBriefly}, ReplaceHead(seen, after)};
  if (after.row.info.revision > seen.row.info.revision + 1) {
    Values& lost = calls.emplace_back(Call{&kNoteLost}).values;
    lost.Add(seen.row.key).Add(seen.row.info.revision + 1).Add(after.row.info.revision - 1);
  }
  const bool was_dead = seen.owner != 0 && seen.owner != taking.server;
  if (was_dead) calls.emplace_back(Call{&kIsStillDead}).values.Add(seen.owner).Add(taking.beat);
  calls.push_back({&CommitText()});
  const Answers done = connection.Run(calls, kTakeTask);
  if (IsFenced(done.sqlstate)) return Taken::kChangedMeanwhile;
  if (done.sqlstate == "55P03") return Taken::kBlocked;  // lock_not_available
  if (!done.status.ok()) return done.status;
  return Taken::kYes;
}

Status EndConnectionsOf(Connection& connection, std::int64_t server) {
  Call call{&kEndConnections};
  call.values.Add(ApplicationName(server));
  return connection.Query(call, kTakeTask).status();
}

}  // namespace dhpmap::postgres
