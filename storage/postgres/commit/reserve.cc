// SPDX-License-Identifier: BSD-3-Clause
// Writer's reservations of numbers.
#include <optional>
#include <string>

#include "storage/postgres/commit/writer.h"
#include "storage/postgres/owners/lost_answer.h"
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
  DHPMAP_ASSIGN_OR_RETURN(const MapHead before, pool_.Read<MapHead>([&](Connection& connection) -> Result<MapHead> {
    Call select{&HeadByKey()};
    select.values.Add(map.key);
    DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(select, "reserve numbers"));
    MapHead head;
    if (!answer.Next()) return NoSuchMap(name);
    if (!ReadHead(answer, head)) return DamagedRows(name, "its row has a wrong checksum");
    return head;
  }));
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
