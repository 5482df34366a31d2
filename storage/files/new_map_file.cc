// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/new_map_file.h"

#include <utility>
#include <vector>

#include "storage/rows/tile_rows.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

constexpr char kWriteFileTask[] = "write the map's file";

/// With the map's key in the file, which no checksum of these rows covers.
template <typename Row>
Status InsertPart(Database& file, const Table<Row>& table, std::vector<Row>& rows, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, file.Prepare(table.Insert(), kWriteFileTask));
  for (Row& row : rows) {
    row.map_key = map_key;
    table.BindAll(row, insert);
    DHPMAP_RETURN_IF_ERROR(insert.Run());
  }
  return Status::Ok();
}

}  // namespace

NewMapFile::NewMapFile(Database& file, Transaction transaction, SubmapRowWriter submaps, Statement tile, Statement blob)
    : file_(&file),
      transaction_(std::move(transaction)),
      submap_writer_(std::move(submaps)),
      insert_tile_(std::move(tile)),
      insert_blob_(std::move(blob)) {}

Result<NewMapFile> NewMapFile::Begin(Database& file) {
  DHPMAP_ASSIGN_OR_RETURN(Transaction transaction, Transaction::BeginWrite(file));
  DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter submaps, SubmapRowWriter::Prepare(file));
  DHPMAP_ASSIGN_OR_RETURN(Statement tile,
                          file.Prepare("INSERT INTO tiles (owner_key, x, y, z, layer, blob_key, cells, extent) VALUES "
                                       "(?, ?, ?, ?, ?, ?, ?, ?)",
                                       kWriteFileTask));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement blob,
      file.Prepare("INSERT INTO tile_blobs (blob_key, num_blocks, blob) VALUES (?, ?, ?)", kWriteFileTask));
  return NewMapFile(file, std::move(transaction), std::move(submaps), std::move(tile), std::move(blob));
}

Status NewMapFile::AddMap(const MapRow& map, MapParts parts) {
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, file_->Prepare(Maps().Insert(), kWriteFileTask));
  Maps().BindAll(map, insert);
  DHPMAP_RETURN_IF_ERROR(insert.Run());
  map_key_ = file_->LastInsertRowId();
  DHPMAP_RETURN_IF_ERROR(InsertPart(*file_, ConfigTable(), parts.config, map_key_));
  DHPMAP_RETURN_IF_ERROR(InsertPart(*file_, Classes(), parts.classes, map_key_));
  DHPMAP_RETURN_IF_ERROR(InsertPart(*file_, Sessions(), parts.sessions, map_key_));
  DHPMAP_RETURN_IF_ERROR(InsertPart(*file_, MergedTable(), parts.merged, map_key_));
  DHPMAP_RETURN_IF_ERROR(InsertPart(*file_, PairTable(), parts.pairs, map_key_));
  return InsertPart(*file_, KeptClearTable(), parts.kept_clear, map_key_);
}

Status NewMapFile::AddSubmap(SubmapRow submap) {
  const std::int64_t id = submap.info.id.value;
  submap.map_key = map_key_;  // which its checksum covers: it is sealed anew
  DHPMAP_ASSIGN_OR_RETURN(submap_keys_[id], submap_writer_.Write(std::move(submap)));
  return Status::Ok();
}

Status NewMapFile::AddTile(const TileOfMap& tile) {
  std::int64_t owner_key = OwnerOfMap(map_key_);
  if (tile.submap_id >= 0) {
    const auto submap = submap_keys_.find(tile.submap_id);
    if (submap == submap_keys_.end()) {
      return DataLoss("has tiles of submap " + std::to_string(tile.submap_id) + " alone").WithReason("DAMAGED_MAP");
    }
    owner_key = submap->second;
  }
  insert_tile_.Bind(owner_key).Bind(tile.index.x).Bind(tile.index.y).Bind(tile.index.z).Bind(tile.layer);
  insert_tile_.Bind(tile.blob_key).Bind(static_cast<std::int64_t>(tile.cells));
  return insert_tile_.Bind(static_cast<std::int64_t>(tile.extent)).Run();
}

Status NewMapFile::AddBlob(std::int64_t blob_key, std::int64_t num_blocks, ByteView blob) {
  return insert_blob_.Bind(blob_key).Bind(num_blocks).Bind(blob).Run();
}

Status NewMapFile::Finish() {
  DHPMAP_RETURN_IF_ERROR(file_->Execute(
      "INSERT INTO shared_blobs SELECT blob_key, count(*) - 1 FROM tiles GROUP BY blob_key HAVING count(*) > 1; "
      "INSERT INTO backups (time_ns) SELECT update_time_ns FROM maps",  // of the state, so that it is always the same
      kWriteFileTask));
  return transaction_.Commit();
}

}  // namespace dhpmap
