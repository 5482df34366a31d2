// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/transit/map_arrival.h"

#include <utility>

#include "storage/paging/tile_cells.h"
#include "storage/rows/map_parts.h"
#include "storage/sqlite/transaction.h"

namespace dhpmap::postgres {
namespace {

using sqlite::Transaction;

constexpr char kArrivalTask[] = "import the map";
constexpr std::size_t kStepRows = 2'000;
const std::string kNameArrived = "INSERT INTO map_names (name, map_key) VALUES ($1, $2)";

/// Writes them into the file, which no other process uses. Older versions did not write them, and commits need them
/// here.
Status NoteCellsOf(MapFile& file) {
  const auto write = [&file](const std::function<Status(sqlite::Database&)>& body) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(Transaction transaction, Transaction::BeginWrite(file.database()));
    DHPMAP_RETURN_IF_ERROR(body(file.database()));
    return transaction.Commit();
  };
  return NoteTileCells(write, file.map_name());
}

}  // namespace

MapArrival::~MapArrival() {
  if (!incoming_) return;
  incoming_.reset();  // releases the lock
  on_abandoned_();
}

Status MapArrival::Write(std::vector<Call>& calls) {
  for (bool is_second = false;; is_second = true) {
    DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow(is_second));
    const Answers done = connection->Run(calls, kArrivalTask);
    if (done.outcome == Outcome::kUnknown && !is_second) continue;
    calls.clear();
    return done.status;
  }
}

Status MapArrival::WriteIfMany(std::vector<Call>& calls) {
  return calls.size() < kStepRows ? Status::Ok() : Write(calls);
}

Status MapArrival::Bring(const std::stop_token& stop) {
  DHPMAP_RETURN_IF_ERROR(NoteCellsOf(file_));
  DHPMAP_ASSIGN_OR_RETURN(const Transaction reading, Transaction::BeginRead(file_.database()));
  DHPMAP_ASSIGN_OR_RETURN(FileHead from, ReadFileHead(file_));
  DHPMAP_ASSIGN_OR_RETURN(blobs_, BlobKeys::Of(file_, stop));
  num_uses_.resize(blobs_.size());
  DHPMAP_ASSIGN_OR_RETURN(IncomingMap incoming, IncomingMap::Begin(options_));
  incoming_.emplace(std::move(incoming));
  DHPMAP_RETURN_IF_ERROR(BringBlobs(stop));
  DHPMAP_RETURN_IF_ERROR(BringTiles(from, stop));
  return BringCounts();
}

Status MapArrival::Add(const std::string& name) {
  head_.row.info.name = name;
  SealMapRow(head_.row);
  std::vector<Call> calls = {{&kNameArrived}, InsertHead(head_)};
  calls[0].values.Add(name).Add(head_.row.key);
  const Answers done = incoming_->Finish(calls);
  const bool is_done = done.outcome == Outcome::kDone && !done.has_warning;
  if (done.status.code() == StatusCode::kAlreadyExists) {
    return AlreadyExists("there is already a map '" + name + "'").WithReason("MAP_EXISTS");
  }
  if (IsFenced(done.sqlstate)) return Unavailable("map '" + name + "': the import was given up by the database");
  if (done.outcome == Outcome::kRefused) return done.status;
  if (!is_done) {
    constexpr bool kNew = true;
    DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow(kNew));
    DHPMAP_ASSIGN_OR_RETURN(const bool has_arrived, HasArrived(*connection, head_.row.key));
    if (!has_arrived) return Unavailable("map '" + name + "': the database did not take the import");
  }
  incoming_.reset();
  return Status::Ok();
}

}  // namespace dhpmap::postgres
