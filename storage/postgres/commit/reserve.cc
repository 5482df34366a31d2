// SPDX-License-Identifier: BSD-3-Clause
// Writer's reservations of numbers.
#include <optional>
#include <string>

#include "storage/postgres/commit/writer.h"
#include "storage/postgres/owners/lost_answer.h"
#include "storage/postgres/reading/named_map.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/transaction_text.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {

Status Writer::Reserve(const std::string& name, const NumberMarks& marks) {
  DHPMAP_ASSIGN_OR_RETURN(const std::shared_ptr<OwnedMap> map, maps_.Own(name, MapOwnership::For::kWriting));
  const MutexLock lock(map->mutex);
  Status done = ReserveOwned(*map, marks);
  return done.reason() == Reason("NOT_OWNER") ? maps_.LoseAndAsk(*map) : done;
}

Status Writer::ReserveOwned(OwnedMap& map, const NumberMarks& marks) {
  const std::string& name = map.name;
  if (map.doubt) {
    DHPMAP_ASSIGN_OR_RETURN(const bool was_made, sender_.Settle(map));
    if (!was_made) map.doubt.reset();
  }
  // With its parts, by which it is checked: it gets a new checksum.
  DHPMAP_ASSIGN_OR_RETURN(const NamedMap stored,
                          pool_.Read<NamedMap>([&name](Connection& connection) -> Result<NamedMap> {
                            DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
                            return ReadNamedMap(connection, name);
                          }));
  const MapHead& before = stored.head;
  if (before.row.key != map.key) return NoSuchMap(name);
  if (before.owner_epoch != map.epoch) return NotOwner(name);
  MapHead after = before;
  ++after.commit_id;
  after.row.marks = marks;
  RaiseMarks(after.row);
  SealMapRow(after.row);
  const std::vector<Call> calls = {{&BeginText()}, ReplaceHead(before, after), {&CommitText()}};
  DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow());
  if (map.doubt) {  // the commit was made: the next commit must know, whether or not this call succeeds
    const Answers done = connection->Run(calls, "reserve numbers");
    if (!done.status.ok()) return done.status;
    return IsAcknowledged(done) ? Status::Ok() : InDoubt(name);
  }
  return sender_.Send(map, std::move(connection), calls, [&]() -> Doubt {
    return {after.commit_id, before.row.info.revision, false, nullptr};
  });
}

}  // namespace dhpmap::postgres
