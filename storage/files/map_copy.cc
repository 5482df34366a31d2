// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/map_copy.h"

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

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

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

/// What a database has by now of the blobs of a file.
struct Brought {
  const BlobKeys& blobs;
  const std::vector<BroughtSize>& sizes;  ///< of each
  std::int64_t first_key;                 ///< of the first in the database
};

/// Copies the rows of one owner after another from a file whose blobs were copied before. Other writers wait meanwhile,
/// so it does not touch pages of blobs.
class TileRowCopier {
 public:
  static Result<TileRowCopier> Prepare(MapFile& file, Database& database, const Brought& brought) {
    DHPMAP_ASSIGN_OR_RETURN(FileTiles tiles, FileTiles::Prepare(file));
    DHPMAP_ASSIGN_OR_RETURN(TileRows rows, TileRows::Prepare(database));
    return TileRowCopier(std::move(tiles), std::move(rows), brought);
  }

  Result<TileTotals> Copy(std::int64_t from_owner_key, std::int64_t to_owner_key) {
    TileTotals totals;
    const Status copied = tiles_.ForEach(from_owner_key, [&](const FileTiles::Row& row) -> Status {
      const auto rank = brought_.blobs.RankOf(row.blob_key);
      if (!rank) return MissingTile();
      const BroughtSize& size = brought_.sizes[*rank];
      const StoredBlob blob{.key = brought_.first_key + static_cast<std::int64_t>(*rank),
                            .num_blocks = size.num_blocks,
                            .bytes = size.bytes,
                            .cells = row.cells,
                            .extent = row.extent};
      ++num_uses_[*rank];
      return rows_.Put(to_owner_key, row.index, row.layer, {}, blob, totals);
    });
    if (!copied.ok()) return copied;
    return totals;
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
  TileRowCopier(FileTiles tiles, TileRows rows, const Brought& brought)
      : tiles_(std::move(tiles)), rows_(std::move(rows)), brought_(brought) {
    num_uses_.resize(brought.sizes.size());
  }

  FileTiles tiles_;
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

Status MapCopy::Bring(const std::stop_token& stop) {
  DHPMAP_ASSIGN_OR_RETURN(const Transaction reading, Transaction::BeginRead(file_.database()));
  DHPMAP_ASSIGN_OR_RETURN(blobs_, BlobKeys::Of(file_, stop));
  const auto reserve = [this](Database& database) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(keys_, ReserveBlobKeys(database, static_cast<std::int64_t>(blobs_.size())));
    target_.kept.Keep(*keys_);
    return Status::Ok();
  };
  DHPMAP_RETURN_IF_ERROR(target_.write(Durability::kNormal, reserve));
  while (sizes_.size() < blobs_.size()) {
    if (stop.stop_requested()) return NobodyWaits();
    DHPMAP_RETURN_IF_ERROR(BringStep());
  }
  return Status::Ok();
}

/// Reads some blobs, then writes them: the disk is not waited for while others wait for the writer.
Status MapCopy::BringStep() {
  const std::size_t next = sizes_.size();
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<FileBlob> step, ReadSomeBlobs(file_, blobs_, next, kStepBytes));
  Status written = target_.write(Durability::kNormal, [&](Database& database) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(BroughtBlobs brought, BroughtBlobs::Prepare(database));
    for (std::size_t i = 0; i < step.size(); ++i) {
      DHPMAP_RETURN_IF_ERROR(brought.Insert(NewKeyOf(next + i), step[i].num_blocks, step[i].bytes));
    }
    return Status::Ok();
  });
  for (const FileBlob& blob : step) sizes_.push_back(SizeOf(blob));
  return written;
}

Status MapCopy::Add(const std::string& name) {
  return target_.write(Durability::kFull, [&](Database& database) { return WriteRows(database, name); });
}

Status MapCopy::WriteRows(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const Transaction reading, Transaction::BeginRead(file_.database()));
  DHPMAP_ASSIGN_OR_RETURN(FileHead from, ReadFileHead(file_));
  const MapRow& map = from.map;
  std::vector<SubmapRow>& rows = from.submaps;
  MapInfo info = map.info;
  info.name = name;
  info.history_id = DrawHistoryId();
  const MapSnapshot snapshot = WithoutVoxels(std::move(info), rows);
  DHPMAP_ASSIGN_OR_RETURN(const MapRow head, InsertMap(database, snapshot));
  DHPMAP_ASSIGN_OR_RETURN(TileRowCopier tiles, TileRowCopier::Prepare(file_, database, {blobs_, sizes_, keys_->first}));
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
