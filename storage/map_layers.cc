// SPDX-License-Identifier: BSD-3-Clause
#include "storage/map_layers.h"

#include <string>
#include <utility>

#include "storage/codec/free_codec.h"
#include "storage/rows/tile_rows.h"

namespace dhpmap {
namespace {

Status AddBytes(sqlite::Database& database, std::int64_t map_key, std::int64_t bytes) {
  DHPMAP_ASSIGN_OR_RETURN(
      sqlite::Statement update,
      database.Prepare("UPDATE maps SET tile_bytes = tile_bytes + ? WHERE map_key = ?", "write the map"));
  return update.Bind(bytes).Bind(map_key).Run();
}

/// Adds to `sum` what changes in the store.
Status WriteLayer(sqlite::Database& database, std::int64_t map_key, MapLayer layer, BlobKind kind,
                  const FreeSpaceChange& change, BlockDelta& sum) {
  if (change.empty()) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(TileRowWriter rows, TileRowWriter::Prepare(database, map_key, layer));
  const auto count = [&sum](const BlockDelta& delta) {
    sum.rows += delta.rows;
    sum.bytes += delta.bytes;
  };
  for (const TileIndex index : change.erased) {
    DHPMAP_ASSIGN_OR_RETURN(const BlockDelta delta, rows.Erase(index));
    count(delta);
  }
  for (const FreeTileEntry* entry : change.written) {
    DHPMAP_ASSIGN_OR_RETURN(const BlockDelta delta,
                            rows.Write(entry->index, EncodeFreeTile(kind, *entry->tile, entry->index)));
    count(delta);
  }
  return Status::Ok();
}

}  // namespace

Status WriteMapLayers(sqlite::Database& database, std::int64_t map_key, std::int64_t num_stored,
                      const StateMarks& before, const MapSnapshot& after) {
  BlockDelta sum{.rows = num_stored, .bytes = 0};
  DHPMAP_RETURN_IF_ERROR(WriteLayer(database, map_key, MapLayer::kFree, BlobKind::kFreeV1,
                                    DiffFreeSpace(before, *after.free_space()), sum));
  DHPMAP_RETURN_IF_ERROR(WriteLayer(database, map_key, MapLayer::kVacated, BlobKind::kVacatedV1,
                                    DiffVacated(before, *after.vacated()), sum));
  if (sum.rows != NumTilesOf(after)) {
    return FailedPrecondition("the store holds another state of the free space than the one the commit starts from")
        .WithReason("STALE_STATE");
  }
  return sum.bytes == 0 ? Status::Ok() : AddBytes(database, map_key, sum.bytes);
}

Result<MapLayers> ReadMapLayers(sqlite::Database& database, std::int64_t map_key, std::int64_t num_tiles) {
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::Prepare(database));
  const auto free_space = std::make_shared<FreeSpace>(), vacated = std::make_shared<FreeSpace>();
  std::int64_t num_read = 0;
  DHPMAP_RETURN_IF_ERROR(rows.ForEach(map_key, [&](std::int64_t layer, TileIndex index, ByteView blob) -> Status {
    ++num_read;
    const bool is_free = layer == static_cast<std::int64_t>(MapLayer::kFree);
    if (!is_free && layer != static_cast<std::int64_t>(MapLayer::kVacated)) {
      return FailedPrecondition(TileName(layer, index) + " is of a layer unknown to this version");
    }
    auto tile = std::make_shared<FreeTile>();
    const Status decoded = DecodeFreeTile(is_free ? BlobKind::kFreeV1 : BlobKind::kVacatedV1, blob, index, *tile);
    if (!decoded.ok()) return {decoded.code(), TileName(layer, index) + " " + decoded.message()};
    (is_free ? free_space : vacated)->Put(index, std::move(tile));
    return Status::Ok();
  }));
  if (num_read == num_tiles) return MapLayers{free_space, vacated};
  return DataLoss("has " + std::to_string(num_read) + " tiles, not " + std::to_string(num_tiles));
}

}  // namespace dhpmap
