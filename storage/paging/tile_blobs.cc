// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/tile_blobs.h"

#include "storage/paging/submap_tiles.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

Status DecodeLayer(sqlite::Statement& select, const ObjectLayer& layer, std::int64_t key, TileIndex index,
                   BlockTile& tile, bool& is_there) {
  DHPMAP_ASSIGN_OR_RETURN(is_there, select.Bind(key).Step());
  if (!is_there) return Status::Ok();
  Status decoded = layer.decode(select.Blob(0), index, tile);
  select.Reset();
  return decoded;
}

Result<std::vector<BlockEntry>> ReadLayers(sqlite::Database& database, const std::string& name, const TileOwner& owner,
                                           const TileOnDisk& tile) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement select,
                          database.Prepare("SELECT blob FROM tile_blobs WHERE blob_key = ?", "read a tile"));
  BlockTile decoded;
  for (const ObjectLayer& layer : ObjectLayers()) {
    const std::int64_t key = tile.keys[static_cast<std::size_t>(layer.layer)];
    if (key == 0) continue;
    bool is_there = true;
    Status status = DecodeLayer(select, layer, key, tile.index, decoded, is_there);
    if (is_there && status.ok()) continue;
    const std::string place = name + ": " + NameOfTile(std::string(layer.name), tile.index);
    if (!is_there) {
      DHPMAP_ASSIGN_OR_RETURN(const bool is_given_up, IsGivenUp(database, owner, key));
      if (is_given_up) return Expired(place);
      status = DataLoss("is missing");
    }
    Status named(status.code(), place + " " + status.message());
    named.WithReason(status.code() == StatusCode::kDataLoss ? Reason("DAMAGED_MAP") : status.reason());
    return named;
  }
  return std::vector<BlockEntry>(decoded.entries().begin(), decoded.entries().end());
}

}  // namespace

Result<std::vector<BlockEntry>> TileBlobs::Read(const std::string& name, const TileOwner& owner,
                                                const TileOnDisk& tile) {
  return With<std::vector<BlockEntry>>(
      name, [&](sqlite::Database& database) { return ReadLayers(database, name, owner, tile); });
}

}  // namespace dhpmap
