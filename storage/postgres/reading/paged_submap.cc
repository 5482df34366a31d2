// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/paged_submap.h"

#include <map>
#include <span>
#include <utility>

#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadTask[] = "read a tile";

const std::string kBlobs = "SELECT blob_key, blob FROM tile_blobs WHERE map_key = $1 AND blob_key = ANY ($2)";
const std::string kRowsOfSubmap =
    "SELECT t.x, t.y, t.z, t.layer, t.blob_key, coalesce(c.num_refs, 1) > 1, t.cells, t.extent FROM tiles t LEFT JOIN "
    "blob_counts c ON c.map_key = t.map_key AND c.blob_key = t.blob_key WHERE t.map_key = $1 AND t.owner_id = $2 ORDER "
    "BY t.x, t.y, t.z, t.layer";
// One statement, so the rows match the sum.
const std::string kRowsOfTile =
    "SELECT s.tiles_sum, t.layer IS NULL, t.x, t.y, t.z, t.layer, t.blob_key, coalesce(c.num_refs, 1) > 1, t.cells, "
    "t.extent FROM submaps s LEFT JOIN tiles t ON t.map_key = s.map_key AND t.owner_id = s.submap_id AND t.x = $3 AND "
    "t.y = $4 AND t.z = $5 LEFT JOIN blob_counts c ON c.map_key = t.map_key AND c.blob_key = t.blob_key WHERE "
    "s.map_key = $1 AND s.submap_id = $2 ORDER BY t.layer";
const std::string kRevision = "SELECT revision FROM maps WHERE map_key = $1";
const std::string kIsReferredTo = "SELECT EXISTS (SELECT 1 FROM tiles WHERE map_key = $1 AND blob_key = $2)";

TileRow RowOf(Answer& answer) {
  TileRow row;
  for (std::int32_t* axis : {&row.index.x, &row.index.y, &row.index.z}) *axis = static_cast<std::int32_t>(answer.Int());
  row.layer = answer.Int();
  row.blob_key = answer.Int();
  row.is_shared = answer.Int() != 0;
  row.cells = static_cast<std::uint64_t>(answer.Int());
  row.extent = static_cast<std::uint64_t>(answer.Int());
  return row;
}

}  // namespace

PagedSubmap::PagedSubmap(PagedMap map, std::uint16_t store, std::shared_ptr<SharedTiles> shared,
                         const std::string& map_name, const SubmapRow& row)
    : SubmapTiles(store, std::move(shared), map_name, row),
      map_(std::move(map)),
      owner_id_(std::int64_t{row.info.id.value}) {}

Result<std::vector<BlockEntry>> PagedSubmap::Read(const TileOnDisk& tile) {
  return map_.reader->With<std::vector<BlockEntry>>(
      name(), [&](Connection& connection) { return ReadLayers(connection, tile); });
}

Result<std::vector<BlockEntry>> PagedSubmap::ReadLayers(Connection& connection, const TileOnDisk& tile) const {
  std::vector<std::int64_t> keys;
  for (const std::int64_t key : tile.keys) {
    if (key != 0) keys.push_back(key);
  }
  Call call{&kBlobs};
  call.values.Add(map_.map_key).Add(std::span<const std::int64_t>(keys));
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadTask));
  std::map<std::int64_t, Bytes> blobs;
  while (answer.Next()) {
    const std::int64_t key = answer.Int();
    const ByteView blob = answer.Blob();
    blobs[key].assign(blob.begin(), blob.end());
  }
  BlockTile decoded;
  for (const ObjectLayer& layer : ObjectLayers()) {
    const std::int64_t key = tile.keys[static_cast<std::size_t>(layer.layer)];
    if (key == 0) continue;
    const std::string place = name() + ": " + NameOfTile(std::string(layer.name), tile.index);
    const auto blob = blobs.find(key);
    if (blob == blobs.end()) return WhyMissing(connection, key, place);
    const Status status = layer.decode(blob->second, tile.index, decoded);
    if (status.ok()) continue;
    Status named(status.code(), place + " " + status.message());
    named.WithReason(status.code() == StatusCode::kDataLoss ? Reason("DAMAGED_MAP") : status.reason());
    return named;
  }
  return std::vector<BlockEntry>(decoded.entries().begin(), decoded.entries().end());
}

Result<std::vector<TileDirectory::Tile>> PagedSubmap::ReadAll() {
  return map_.reader->With<std::vector<Tile>>(name(), [this](Connection& connection) -> Result<std::vector<Tile>> {
    Call call{&kRowsOfSubmap};
    call.values.Add(map_.map_key).Add(owner_id_);
    DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadTask));
    Collector all(*this);
    while (answer.Next()) DHPMAP_RETURN_IF_ERROR(all.Add(RowOf(answer)));
    if (all.AreOthers()) return WhyOthers(connection);
    const Status found = all.Check();
    if (!found.ok()) return Damaged(found);
    return all.Tiles();
  });
}

Result<std::shared_ptr<const BlockTile>> PagedSubmap::ReadOne(TileIndex index) {
  using Made = std::shared_ptr<const BlockTile>;
  return map_.reader->With<Made>(name(), [&](Connection& connection) -> Result<Made> {
    Call call{&kRowsOfTile};
    call.values.Add(map_.map_key).Add(owner_id_).Add(index.x).Add(index.y).Add(index.z);
    DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadTask));
    Rows rows;
    rows.tile.index = index;
    bool has_submap = false;
    while (answer.Next()) {
      has_submap = true;
      if (tiles_sum() && answer.Int() != *tiles_sum()) return WhyOthers(connection);
      const bool has_no_tile = answer.Int() != 0;
      if (!has_no_tile) DHPMAP_RETURN_IF_ERROR(Add(RowOf(answer), rows));
    }
    if (!has_submap) return WhyOthers(connection);
    return AnyOf(rows.tile.cells) != 0 ? Make(rows) : nullptr;
  });
}

Result<bool> PagedSubmap::HasGoneOn(Connection& connection) const {
  Call call{&kRevision};
  call.values.Add(map_.map_key);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadTask));
  return !answer.Next() || answer.Int() != map_.revision;
}

Status PagedSubmap::WhyMissing(Connection& connection, std::int64_t blob_key, const std::string& place) const {
  Call call{&kIsReferredTo};
  call.values.Add(map_.map_key).Add(blob_key);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadTask));
  const bool is_referred_to = answer.Next() && answer.Int() != 0;
  DHPMAP_ASSIGN_OR_RETURN(const bool has_gone_on, HasGoneOn(connection));
  if (has_gone_on && !is_referred_to) return Expired(place);
  return DataLoss(place + " is missing").WithReason("DAMAGED_MAP");
}

Status PagedSubmap::WhyOthers(Connection& connection) const {
  DHPMAP_ASSIGN_OR_RETURN(const bool has_gone_on, HasGoneOn(connection));
  return has_gone_on ? Expired(name() + ": what is asked for") : Damaged(OtherTiles());
}

}  // namespace dhpmap::postgres
