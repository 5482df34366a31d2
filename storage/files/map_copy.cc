// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/map_copy.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "mapping/map/history_id.h"
#include "storage/rows/brought_blobs.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/transaction.h"

namespace dhpmap {
namespace {

using sqlite::Columns;
using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

constexpr char kReadFileTask[] = "read the file";
constexpr char kAddMapTask[] = "add the map";
constexpr std::uint64_t kGeneration = 1;
/// Takes the writer a few milliseconds.
constexpr std::size_t kStepBytes = 512u << 10;

/// A snapshot for writing the map's row: its submaps without voxels.
MapSnapshot WithoutVoxels(MapInfo info, const std::vector<SubmapRow>& rows) {
  std::vector<std::shared_ptr<const Submap>> submaps;
  submaps.reserve(rows.size());
  for (const SubmapRow& row : rows) submaps.push_back(std::make_shared<const Submap>(row.info, kGeneration));
  return {std::move(info), std::move(submaps)};
}

/// The blobs of a file that were copied to the database; their keys in the file ascend.
struct Brought {
  const std::vector<std::int64_t>& blobs;
  const std::vector<BroughtSize>& sizes;  ///< of each blob
  std::int64_t first_key;                 ///< of the first blob in the database
};

/// Copies the rows of one owner after another from a file whose blobs were copied before. Other writers wait meanwhile,
/// so it does not touch pages of blobs.
class TileRowCopier {
 public:
  static Result<TileRowCopier> Prepare(Database& file, Database& database, const Brought& brought) {
    DHPMAP_ASSIGN_OR_RETURN(
        Statement select,
        file.Prepare("SELECT x, y, z, layer, blob_key, cells, extent FROM tiles WHERE owner_key = ?", kReadFileTask));
    DHPMAP_ASSIGN_OR_RETURN(TileRows rows, TileRows::Prepare(database));
    return TileRowCopier(std::move(select), std::move(rows), brought);
  }

  Result<TileTotals> Copy(std::int64_t from_owner_key, std::int64_t to_owner_key) {
    TileTotals totals;
    select_.Bind(from_owner_key);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select_.Step());
      if (!has_row) return totals;
      Columns columns(select_);
      TileIndex index;
      for (std::int32_t* axis : {&index.x, &index.y, &index.z}) *axis = static_cast<std::int32_t>(columns.Int());
      const std::int64_t layer = columns.Int();
      const std::size_t rank = RankOf(columns.Int());
      if (rank == brought_.sizes.size()) return DataLoss("a tile is missing").WithReason("DAMAGED_MAP");
      const BroughtSize& size = brought_.sizes[rank];
      StoredBlob blob{.key = brought_.first_key + static_cast<std::int64_t>(rank),
                      .num_blocks = size.num_blocks,
                      .bytes = size.bytes};
      for (std::uint64_t* known : {&blob.cells, &blob.extent}) *known = static_cast<std::uint64_t>(columns.Int());
      ++num_uses_[rank];
      DHPMAP_RETURN_IF_ERROR(rows_.Put(to_owner_key, index, layer, {}, blob, totals));
    }
  }

  /// Records for each shared blob the number of additional references.
  Status NoteShared(Database& database) const {
    DHPMAP_ASSIGN_OR_RETURN(
        Statement insert, database.Prepare("INSERT INTO shared_blobs (blob_key, num_more) VALUES (?, ?)", kAddMapTask));
    for (std::size_t rank = 0; rank < num_uses_.size(); ++rank) {
      if (num_uses_[rank] < 2) continue;
      const std::int64_t key = brought_.first_key + static_cast<std::int64_t>(rank);
      DHPMAP_RETURN_IF_ERROR(insert.Bind(key).Bind(num_uses_[rank] - 1).Run());
    }
    return Status::Ok();
  }

 private:
  TileRowCopier(Statement select, TileRows rows, const Brought& brought)
      : select_(std::move(select)), rows_(std::move(rows)), brought_(brought) {
    num_uses_.resize(brought.sizes.size());
  }
  [[nodiscard]] std::size_t RankOf(std::int64_t blob_key) const {
    const auto& blobs = brought_.blobs;
    const auto found = std::lower_bound(blobs.begin(), blobs.end(), blob_key);
    const bool is_there = found != blobs.end() && *found == blob_key;
    return is_there ? static_cast<std::size_t>(found - blobs.begin()) : blobs.size();
  }

  Statement select_;
  TileRows rows_;
  const Brought brought_;
  std::vector<std::uint32_t> num_uses_;
};

}  // namespace

MapCopy::~MapCopy() {
  if (!keys_) return;
  target_.kept.LetGo(*keys_);
  // After this the store checks for garbage; if that fails, the next commit does.
  (void)target_.write(Durability::kNormal, [](Database&) { return Status::Ok(); });
}

Status MapCopy::ListBlobs(const std::stop_token& stop) {
  Database& file = file_.database();
  DHPMAP_ASSIGN_OR_RETURN(const MapRow map, ReadMap(file, file_.map_name()));
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          file.Prepare("SELECT blob_key FROM tiles WHERE owner_key = ?1 UNION ALL SELECT blob_key FROM "
                                       "submaps JOIN tiles ON owner_key = submap_key WHERE map_key = ?2",
                                       kReadFileTask));
  select.Bind(OwnerOfMap(map.key)).Bind(map.key);
  for (;;) {
    if (stop.stop_requested()) return NobodyWaits();
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) break;
    blobs_.push_back(select.Int(0));
  }
  std::sort(blobs_.begin(), blobs_.end());
  blobs_.erase(std::unique(blobs_.begin(), blobs_.end()), blobs_.end());
  return Status::Ok();
}

Status MapCopy::BringBlobs(const std::stop_token& stop) {
  DHPMAP_ASSIGN_OR_RETURN(const Transaction reading, Transaction::BeginRead(file_.database()));
  DHPMAP_RETURN_IF_ERROR(ListBlobs(stop));
  const auto reserve = [this](Database& database) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(keys_, ReserveBlobKeys(database, static_cast<std::int64_t>(blobs_.size())));
    target_.kept.Keep(*keys_);
    return Status::Ok();
  };
  DHPMAP_RETURN_IF_ERROR(target_.write(Durability::kNormal, reserve));
  for (std::size_t next = 0; next < blobs_.size();) {
    if (stop.stop_requested()) return NobodyWaits();
    DHPMAP_RETURN_IF_ERROR(BringStep(next));
  }
  return Status::Ok();
}

/// Reads some blobs, then writes them, so that other writers do not wait for reads.
Status MapCopy::BringStep(std::size_t& next) {
  struct Blob {
    std::int64_t num_blocks = 0;
    std::vector<std::uint8_t> bytes;
  };
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      file_.database().Prepare("SELECT num_blocks, blob FROM tile_blobs WHERE blob_key = ?", kReadFileTask));
  std::vector<Blob> step;
  for (std::size_t num_bytes = 0; num_bytes < kStepBytes && next + step.size() < blobs_.size();) {
    DHPMAP_ASSIGN_OR_RETURN(const bool is_there, select.Bind(blobs_[next + step.size()]).Step());
    if (!is_there) return DataLoss("a tile is missing").WithReason("DAMAGED_MAP");
    const ByteView bytes = select.Blob(1);
    step.push_back({select.Int(0), {bytes.begin(), bytes.end()}});
    num_bytes += bytes.size();
    select.Reset();
  }
  Status written = target_.write(Durability::kNormal, [&](Database& database) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(BroughtBlobs brought, BroughtBlobs::Prepare(database));
    for (std::size_t i = 0; i < step.size(); ++i) {
      DHPMAP_RETURN_IF_ERROR(brought.Insert(NewKeyOf(next + i), step[i].num_blocks, step[i].bytes));
    }
    return Status::Ok();
  });
  for (const Blob& blob : step) {
    sizes_.push_back({static_cast<std::uint32_t>(blob.num_blocks), static_cast<std::uint32_t>(blob.bytes.size())});
  }
  next += step.size();
  return written;
}

Status MapCopy::AddRows(const std::string& name) {
  return target_.write(Durability::kFull, [&](Database& database) { return WriteRows(database, name); });
}

Status MapCopy::WriteRows(Database& database, const std::string& name) {
  Database& file = file_.database();
  DHPMAP_ASSIGN_OR_RETURN(const Transaction reading, Transaction::BeginRead(file));
  DHPMAP_ASSIGN_OR_RETURN(const MapRow map, ReadMap(file, file_.map_name()));
  DHPMAP_ASSIGN_OR_RETURN(std::vector<SubmapRow> rows, ReadSubmaps(file, map.key));
  if (rows.empty() || rows[0].info.id != kUnknownSubmap) {
    return DataLoss("the map lacks its unknown submap").WithReason("DAMAGED_MAP");
  }
  MapInfo info = map.info;
  info.name = name;
  info.history_id = DrawHistoryId();
  const MapSnapshot snapshot = WithoutVoxels(std::move(info), rows);
  DHPMAP_ASSIGN_OR_RETURN(const MapRow head, InsertMap(database, snapshot));
  DHPMAP_ASSIGN_OR_RETURN(TileRowCopier tiles, TileRowCopier::Prepare(file, database, {blobs_, sizes_, keys_->first}));
  DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter writer, SubmapRowWriter::Prepare(database));
  for (SubmapRow& row : rows) {
    row.map_key = head.key;
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t key, writer.Write(row));
    DHPMAP_ASSIGN_OR_RETURN(const TileTotals totals, tiles.Copy(row.key, key));
    row.tiles_sum = totals.sum;
    row.counts.blob_bytes = totals.bytes;
    DHPMAP_RETURN_IF_ERROR(writer.Write(row).status());
  }
  DHPMAP_ASSIGN_OR_RETURN(const TileTotals own, tiles.Copy(OwnerOfMap(map.key), OwnerOfMap(head.key)));
  DHPMAP_RETURN_IF_ERROR(tiles.NoteShared(database));
  DHPMAP_RETURN_IF_ERROR(ReviveBlobs(database, *keys_));
  return UpdateMap(database, head, snapshot.info(), snapshot, {own, map.leaving()});
}

}  // namespace dhpmap
