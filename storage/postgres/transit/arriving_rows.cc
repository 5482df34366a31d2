// SPDX-License-Identifier: BSD-3-Clause
// MapArrival: turns the rows of a file into rows of this store.
#include <string>

#include "mapping/map/history_id.h"
#include "storage/postgres/rows/part_writes.h"
#include "storage/postgres/rows/row_diff.h"
#include "storage/postgres/tiles/tile_owner.h"
#include "storage/postgres/transit/map_arrival.h"
#include "storage/rows/map_parts.h"
#include "storage/rows/tile_rows.h"

namespace dhpmap::postgres {
namespace {

constexpr std::size_t kStepBytes = 1u << 20;
constexpr std::int64_t kFirstBlobKey = 1;
// Unlike commits: a step whose answer was lost is sent again.
const std::string kBringBlob =
    "INSERT INTO tile_blobs (map_key, blob_key, num_blocks, blob) VALUES ($1, $2, $3, $4) ON CONFLICT DO NOTHING";
const std::string kBringTile =
    "INSERT INTO tiles (map_key, owner_id, x, y, z, layer, blob_key, num_bytes, cells, extent) VALUES ($1, $2, $3, $4, "
    "$5, $6, $7, $8, $9, $10) ON CONFLICT DO NOTHING";
const std::string kBringCounts =
    "INSERT INTO blob_counts (map_key, blob_key, num_refs, since_ns) SELECT $1, c.blob_key, c.num, 0 FROM unnest($2, "
    "$3) AS c (blob_key, num) ON CONFLICT DO NOTHING";

std::int64_t KeyOfRank(std::size_t rank) { return kFirstBlobKey + static_cast<std::int64_t>(rank); }

}  // namespace

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

/// Includes the submaps' own rows, which name their tiles.
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

/// The map's own row as Add writes it, without the name. Its rows in other tables are written with the rest.
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
  WritePartsBesideConfig({}, parts, waiting_);
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

}  // namespace dhpmap::postgres
