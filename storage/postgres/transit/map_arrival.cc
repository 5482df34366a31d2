// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/transit/map_arrival.h"

#include <utility>

#include "mapping/map/history_id.h"
#include "storage/paging/tile_cells.h"
#include "storage/postgres/commit/tile_writes.h"
#include "storage/postgres/rows/row_diff.h"
#include "storage/rows/map_parts.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/transaction.h"

namespace dhpmap::postgres {
namespace {

using sqlite::Transaction;

constexpr char kArrivalTask[] = "import the map";
constexpr std::size_t kStepBytes = 1u << 20;
constexpr std::size_t kStepRows = 2'000;
constexpr std::int64_t kFirstBlobKey = 1;
// Not as commits write them: a step whose answer was lost is sent again.
const std::string kBringBlob =
    "INSERT INTO tile_blobs (map_key, blob_key, num_blocks, blob) VALUES ($1, $2, $3, $4) ON CONFLICT DO NOTHING";
const std::string kBringTile =
    "INSERT INTO tiles (map_key, owner_id, x, y, z, layer, blob_key, num_bytes, cells, extent) VALUES ($1, $2, $3, $4, "
    "$5, $6, $7, $8, $9, $10) ON CONFLICT DO NOTHING";
const std::string kBringCounts =
    "INSERT INTO blob_counts (map_key, blob_key, num_refs, since_ns) SELECT $1, c.blob_key, c.num, 0 FROM unnest($2, "
    "$3) AS c (blob_key, num) ON CONFLICT DO NOTHING";
const std::string kNameArrived = "INSERT INTO map_names (name, map_key) VALUES ($1, $2)";

/// In the file itself, of which nobody else knows. Older versions did not write them, and commits go by them here.
Status NoteCellsOf(MapFile& file) {
  const auto write = [&file](const std::function<Status(sqlite::Database&)>& body) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(Transaction transaction, Transaction::BeginWrite(file.database()));
    DHPMAP_RETURN_IF_ERROR(body(file.database()));
    return transaction.Commit();
  };
  return NoteTileCells(write, file.map_name());
}

std::int64_t KeyOfRank(std::size_t rank) { return kFirstBlobKey + static_cast<std::int64_t>(rank); }

}  // namespace

MapArrival::~MapArrival() {
  if (!incoming_) return;
  incoming_.reset();  // lets go of the lock
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

Status MapArrival::BringBlobs(const std::stop_token& stop) {
  while (sizes_.size() < blobs_.size()) {
    if (stop.stop_requested()) return NobodyWaits();
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<FileBlob> step, ReadSomeBlobs(file_, blobs_, sizes_.size(), kStepBytes));
    for (const FileBlob& blob : step) {
      Values& values = waiting_.emplace_back(Call{&kBringBlob}).values;
      values.Add(incoming_->key()).Add(KeyOfRank(sizes_.size())).Add(blob.num_blocks).Add(ByteView(blob.bytes));
      sizes_.push_back(SizeOf(blob));
    }
    DHPMAP_RETURN_IF_ERROR(Write(waiting_));
  }
  return Status::Ok();
}

Result<TileTotals> MapArrival::CopyTiles(FileTiles& tiles, std::int64_t from_owner_key, std::int64_t owner_id) {
  TileTotals totals;
  const Status copied = tiles.ForEach(from_owner_key, [&](const FileTiles::Row& row) -> Status {
    const auto rank = blobs_.RankOf(row.blob_key);
    if (!rank) return MissingTile();
    const std::int64_t num_bytes = sizes_[*rank].bytes;
    ++num_uses_[*rank];
    totals.Add(row.index, row.layer, {.key = KeyOfRank(*rank), .bytes = num_bytes});
    Values& values = waiting_.emplace_back(Call{&kBringTile}).values;
    values.Add(incoming_->key()).Add(owner_id).Add(row.index.x).Add(row.index.y).Add(row.index.z).Add(row.layer);
    values.Add(KeyOfRank(*rank)).Add(num_bytes).Add(static_cast<std::int64_t>(row.cells));
    values.Add(static_cast<std::int64_t>(row.extent));
    return WriteIfMany(waiting_);
  });
  if (!copied.ok()) return copied;
  return totals;
}

/// With the submaps' own rows, which say what tiles they have.
Status MapArrival::BringTiles(FileHead& from, const std::stop_token& stop) {
  static const std::string upsert = UpsertText(Submaps());
  DHPMAP_ASSIGN_OR_RETURN(FileTiles tiles, FileTiles::Prepare(file_));
  for (SubmapRow& row : from.submaps) {
    if (stop.stop_requested()) return NobodyWaits();
    DHPMAP_ASSIGN_OR_RETURN(const TileTotals totals, CopyTiles(tiles, row.key, row.info.id.value));
    row.map_key = incoming_->key();
    row.tiles_sum = totals.sum;
    row.counts.blob_bytes = totals.bytes;
    row.seal = Submaps().SealOf(row);
    Submaps().BindAll(row, waiting_.emplace_back(Call{&upsert}).values);
    DHPMAP_RETURN_IF_ERROR(WriteIfMany(waiting_));
  }
  DHPMAP_ASSIGN_OR_RETURN(const TileTotals own, CopyTiles(tiles, OwnerOfMap(from.map.key), kMapsOwner));
  PrepareHead(from, own);
  return Write(waiting_);
}

/// The map's own row as Add writes it, but for the name; what belongs to it in other tables goes with the rest.
void MapArrival::PrepareHead(const FileHead& from, const TileTotals& own_tiles) {
  constexpr std::int64_t kFirstCommit = 1, kFirstEpoch = 1, kNobody = 0;
  head_ = {.row = {.key = incoming_->key(),
                   .info = from.map.info,
                   .num_submaps = static_cast<std::int64_t>(from.submaps.size()),
                   .tiles = own_tiles,
                   .leaving_id = from.map.leaving_id,
                   .seal = {}},
           .commit_id = kFirstCommit,
           .owner = kNobody,
           .owner_epoch = kFirstEpoch,
           .next_blob_key = KeyOfRank(blobs_.size())};
  MapRow& row = head_.row;
  row.info.history_id = DrawHistoryId();
  RaiseMarks(row);
  const MapParts parts = MapPartsOf(row.key, row.info);
  SealMapParts(row, parts);
  WriteDiff(ConfigTable(), {}, parts.config, waiting_);
  WriteDiff(Classes(), {}, parts.classes, waiting_);
  WriteDiff(Sessions(), {}, parts.sessions, waiting_);
  WriteDiff(MergedTable(), {}, parts.merged, waiting_);
  WriteDiff(PairTable(), {}, parts.pairs, waiting_);
  WriteDiff(KeptClearTable(), {}, parts.kept_clear, waiting_);
}

Status MapArrival::BringCounts() {
  constexpr std::size_t kCountsAStep = 50'000;
  std::vector<std::int64_t> keys, numbers;
  for (std::size_t rank = 0; rank <= num_uses_.size(); ++rank) {
    const bool is_end = rank == num_uses_.size();
    if (!is_end && num_uses_[rank] > 1) {
      keys.push_back(KeyOfRank(rank));
      numbers.push_back(num_uses_[rank]);
    }
    if (keys.empty() || (!is_end && keys.size() < kCountsAStep)) continue;
    Values& values = waiting_.emplace_back(Call{&kBringCounts}).values;
    values.Add(incoming_->key()).Add(std::span<const std::int64_t>(keys)).Add(std::span<const std::int64_t>(numbers));
    DHPMAP_RETURN_IF_ERROR(Write(waiting_));
    keys.clear();
    numbers.clear();
  }
  return Status::Ok();
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
