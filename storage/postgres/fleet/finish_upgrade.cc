// SPDX-License-Identifier: BSD-3-Clause
// FleetMember's part in an upgrade of the servers.
#include <algorithm>
#include <utility>

#include "storage/postgres/fleet/fleet_member.h"
#include "storage/postgres/fleet/upgrade.h"

namespace dhpmap::postgres {

FleetSchema FleetMember::Schema() const {
  FleetSchema schema{.in_force = schema_.in_force(), .newest = schema_.newest()};
  for (const Peers::Judged& server : peers_.All()) {
    if (server.verdict != Peers::Verdict::kDead) schema.newest = std::max(schema.newest, server.row.knows_schema);
  }
  return schema;
}

Result<FleetSchema> FleetMember::FinishUpgrade() {
  DHPMAP_RETURN_IF_ERROR(Beat());  // so the other servers' rows are present ones
  const std::int64_t newest = Schema().newest;
  std::vector<ServerRow> dead;
  std::string behind;
  for (const Peers::Judged& server : peers_.All()) {
    if (server.row.knows_schema >= newest) continue;
    if (server.verdict == Peers::Verdict::kDead) dead.push_back(server.row);
    else behind += (behind.empty() ? "" : ", ") + DescribeServer(server.row);
  }
  if (!behind.empty()) {
    return FailedPrecondition("the database stays at schema " + std::to_string(schema_.in_force()) +
                              ", for these servers do not know schema " + std::to_string(newest) + ": " + behind);
  }
  if (!schema_.Has(newest)) {
    DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow());
    DHPMAP_RETURN_IF_ERROR(Upgrade(*connection, schema_, dead));
  }
  return Schema();
}

FleetCounts FleetMember::Counts() const {
  const MapOwnership::Counts maps = maps_.counts();
  const MutexLock lock(mutex_);
  return {.num_owned = maps.num_owned,
          .num_taken_over = maps.num_taken_over,
          .num_lost = maps.num_lost,
          .num_failed_beats = num_failed_beats_};
}

}  // namespace dhpmap::postgres
