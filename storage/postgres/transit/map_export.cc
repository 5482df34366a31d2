// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/transit/map_export.h"

#include "storage/files/map_file.h"
#include "storage/files/new_map_file.h"
#include "storage/postgres/reading/named_map.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/rows/table_text.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {
namespace {

constexpr char kExportTask[] = "export the map";
const std::string kTilesOfMap =
    "SELECT owner_id, x, y, z, layer, blob_key, cells, extent FROM tiles WHERE map_key = $1 ORDER BY owner_id, x, y, "
    "z, "
    "layer";
/// The blobs that tiles refer to, without undo data and unused blobs.
const std::string kBlobsOfMap =
    "SELECT blob_key, num_blocks, blob FROM tile_blobs WHERE map_key = $1 AND blob_key IN (SELECT t.blob_key FROM "
    "tiles "
    "t WHERE t.map_key = $1) ORDER BY blob_key";

TileOfMap TileFrom(Answer& row) {
  TileOfMap tile;
  tile.submap_id = row.Int();
  for (std::int32_t* axis : {&tile.index.x, &tile.index.y, &tile.index.z}) {
    *axis = static_cast<std::int32_t>(row.Int());
  }
  tile.layer = row.Int();
  tile.blob_key = row.Int();
  for (std::uint64_t* known : {&tile.cells, &tile.extent}) *known = static_cast<std::uint64_t>(row.Int());
  return tile;
}

/// Runs one statement after the other and copies each row as it arrives.
class Exporter {
 public:
  Exporter(Connection& connection, const std::string& name, const std::stop_token& stop)
      : connection_(connection), name_(name), stop_(stop) {}

  Status WriteTo(NewMapFile& file) {
    DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection_));
    DHPMAP_ASSIGN_OR_RETURN(NamedMap map, ReadNamedMap(connection_, name_));
    map_key_ = map.head.row.key;
    DHPMAP_RETURN_IF_ERROR(file.AddMap(map.head.row, std::move(map.parts)));
    static const std::string submaps = SelectText(Submaps(), "WHERE map_key = $1 ORDER BY submap_id");
    DHPMAP_RETURN_IF_ERROR(ForEach(submaps, [&](Answer& row) -> Status {
      SubmapRow submap;
      if (ReadRow(Submaps(), row, submap) && Submaps().IsIntact(submap, submap.seal)) return file.AddSubmap(submap);
      return DamagedRows(name_, "submap " + std::to_string(submap.info.id.value) + ": its row has a wrong checksum");
    }));
    DHPMAP_RETURN_IF_ERROR(ForEach(kTilesOfMap, [&](Answer& row) { return file.AddTile(TileFrom(row)); }));
    DHPMAP_RETURN_IF_ERROR(ForEach(kBlobsOfMap, [&](Answer& row) {
      const std::int64_t key = row.Int(), num_blocks = row.Int();
      return file.AddBlob(key, num_blocks, row.Blob());
    }));
    return file.Finish();
  }

 private:
  Status ForEach(const std::string& text, const std::function<Status(Answer& row)>& visit) {
    Call call{&text};
    call.values.Add(map_key_);
    return connection_.Stream(call, kExportTask,
                              [&](Answer& row) { return stop_.stop_requested() ? NobodyWaits() : visit(row); });
  }

  Connection& connection_;
  const std::string& name_;
  const std::stop_token& stop_;
  std::int64_t map_key_ = 0;
};

}  // namespace

Status WriteMapFileOf(Connection& connection, const std::string& name, const std::string& path,
                      const std::stop_token& stop) {
  const auto write = [&]() -> Status {
    DHPMAP_ASSIGN_OR_RETURN(sqlite::Database database, MakeMapFile(path));
    DHPMAP_ASSIGN_OR_RETURN(NewMapFile file, NewMapFile::Begin(database));
    return Exporter(connection, name, stop).WriteTo(file);
  };
  Status status = write();
  if (status.ok() && stop.stop_requested()) status = NobodyWaits();
  if (!status.ok()) RemoveDatabase(path);
  return status;
}

}  // namespace dhpmap::postgres
