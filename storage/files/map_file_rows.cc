// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/map_file_rows.h"

#include <algorithm>

#include "storage/rows/map_rows.h"
#include "storage/rows/tile_rows.h"

namespace dhpmap {
namespace {

using sqlite::Statement;

constexpr char kReadRowsTask[] = "read the file";

}  // namespace

Status MissingTile() { return DataLoss("a tile is missing").WithReason("DAMAGED_MAP"); }

Result<FileHead> ReadFileHead(MapFile& file) {
  FileHead head;
  DHPMAP_ASSIGN_OR_RETURN(head.map, ReadMap(file.database(), file.map_name()));
  DHPMAP_ASSIGN_OR_RETURN(head.submaps, ReadSubmaps(file.database(), head.map.key));
  if (head.submaps.empty() || head.submaps[0].info.id != kUnknownSubmap) {
    return DataLoss("the map lacks its unknown submap").WithReason("DAMAGED_MAP");
  }
  return head;
}

Result<BlobKeys> BlobKeys::Of(MapFile& file, const std::stop_token& stop) {
  DHPMAP_ASSIGN_OR_RETURN(const MapRow map, ReadMap(file.database(), file.map_name()));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      file.database().Prepare("SELECT blob_key FROM tiles WHERE owner_key = ?1 UNION ALL SELECT blob_key FROM "
                              "submaps JOIN tiles ON owner_key = submap_key WHERE map_key = ?2",
                              kReadRowsTask));
  select.Bind(OwnerOfMap(map.key)).Bind(map.key);
  std::vector<std::int64_t> keys;
  for (;;) {
    if (stop.stop_requested()) return NobodyWaits();
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) break;
    keys.push_back(select.Int(0));
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return BlobKeys(std::move(keys));
}

std::optional<std::size_t> BlobKeys::RankOf(std::int64_t blob_key) const {
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), blob_key);
  const bool is_there = found != keys_.end() && *found == blob_key;
  return is_there ? std::optional(static_cast<std::size_t>(found - keys_.begin())) : std::nullopt;
}

Result<std::vector<FileBlob>> ReadSomeBlobs(MapFile& file, const BlobKeys& keys, std::size_t first,
                                            std::size_t num_bytes) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      file.database().Prepare("SELECT num_blocks, blob FROM tile_blobs WHERE blob_key = ?", kReadRowsTask));
  std::vector<FileBlob> blobs;
  for (std::size_t read = 0; read < num_bytes && first + blobs.size() < keys.size();) {
    DHPMAP_ASSIGN_OR_RETURN(const bool is_there, select.Bind(keys[first + blobs.size()]).Step());
    if (!is_there) return MissingTile();
    const ByteView bytes = select.Blob(1);
    blobs.push_back({select.Int(0), {bytes.begin(), bytes.end()}});
    read += bytes.size();
    select.Reset();
  }
  return blobs;
}

BroughtSize SizeOf(const FileBlob& blob) {
  return {static_cast<std::uint32_t>(blob.num_blocks), static_cast<std::uint32_t>(blob.bytes.size())};
}

Result<FileTiles> FileTiles::Prepare(MapFile& file) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      file.database().Prepare("SELECT x, y, z, layer, blob_key, cells, extent FROM tiles WHERE owner_key = ?",
                              kReadRowsTask));
  return FileTiles(std::move(select));
}

Status FileTiles::ForEach(std::int64_t owner_key, const std::function<Status(const Row&)>& visit) {
  select_.Bind(owner_key);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select_.Step());
    if (!has_row) return Status::Ok();
    sqlite::Columns columns(select_);
    Row row;
    for (std::int32_t* axis : {&row.index.x, &row.index.y, &row.index.z}) {
      *axis = static_cast<std::int32_t>(columns.Int());
    }
    row.layer = columns.Int();
    row.blob_key = columns.Int();
    for (std::uint64_t* known : {&row.cells, &row.extent}) *known = static_cast<std::uint64_t>(columns.Int());
    Status visited = visit(row);
    if (visited.ok()) continue;
    select_.Reset();
    return visited;
  }
}

}  // namespace dhpmap
