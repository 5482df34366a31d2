// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/owners/lost_answer.h"

#include "storage/postgres/postgres_error.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

constexpr char kAskTask[] = "ask what became of a commit";
// A plain SELECT would not see a commit that still waits for its standbys and becomes visible later.
const std::string kPresentCommit = "SELECT commit_id, owner_epoch FROM maps WHERE map_key = $1 FOR UPDATE";

}  // namespace

Status NotOwner(const std::string& map) {
  return Unavailable("map '" + map + "' is written by another server now").WithReason("NOT_OWNER");
}

Result<bool> WasMade(Pool& pool, const OwnedMap& map, std::int64_t commit_id) {
  constexpr bool kNew = true;
  DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool.Borrow(kNew));
  Call call{&kPresentCommit};
  call.values.Add(map.key);
  Answers asked = connection->Run({&call, 1}, kAskTask);
  if (!asked.status.ok()) return asked.status;
  // Locking a row writes, so it waits for the standbys too, unless an administrator ends that wait.
  if (asked.has_warning) return ConnectionLost(kAskTask, "no standby has answered");
  Answer& answer = asked.answers.front();
  if (!answer.Next()) return NoSuchMap(map.name);
  const std::int64_t present = answer.Int(), epoch = answer.Int();
  if (epoch != map.epoch) return NotOwner(map.name);
  return present >= commit_id;
}

}  // namespace dhpmap::postgres
