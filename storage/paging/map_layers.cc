// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/map_layers.h"

#include <string>
#include <utility>

#include "storage/codec/free_codec.h"
#include "storage/history/edit_tiles.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

std::string NameOf(std::int64_t layer, TileIndex index) {
  switch (layer) {
    case LayerNumber(BlobKind::kFreeV1): return NameOfTile("free-space", index);
    case LayerNumber(BlobKind::kVacatedV1): return NameOfTile("vacated", index);
    default: return NameOfTile("layer " + std::to_string(layer), index);
  }
}

Status WriteLayer(TileTable& rows, std::int64_t owner_key, BlobKind kind, const FreeSpaceChange& change,
                  TileTotals& totals, EditTiles* recorder) {
  const std::size_t layer = LayerNumber(kind);
  for (const TileIndex index : change.erased) {
    DHPMAP_ASSIGN_OR_RETURN(const StoredLayers stored, rows.Find(owner_key, index));
    if (recorder != nullptr) {
      DHPMAP_RETURN_IF_ERROR(recorder->Note(kMapsOwnTiles, index, LayerNumber(kind), stored[layer], StoredBlob()));
    }
    DHPMAP_RETURN_IF_ERROR(rows.Erase(owner_key, index, LayerNumber(kind), stored[layer], totals));
  }
  for (const FreeTileEntry* entry : change.written) {
    DHPMAP_ASSIGN_OR_RETURN(const StoredLayers stored, rows.Find(owner_key, entry->index));
    constexpr std::int64_t kNoBlocks = 0;
    DHPMAP_ASSIGN_OR_RETURN(const StoredBlob blob,
                            rows.Insert(EncodeFreeTile(kind, *entry->tile, entry->index), kNoBlocks));
    if (recorder != nullptr) {
      DHPMAP_RETURN_IF_ERROR(recorder->Note(kMapsOwnTiles, entry->index, LayerNumber(kind), stored[layer], blob));
    }
    DHPMAP_RETURN_IF_ERROR(rows.Put(owner_key, entry->index, LayerNumber(kind), stored[layer], blob, totals));
  }
  return Status::Ok();
}

}  // namespace

Result<TileTotals> WriteMapLayers(TileTable& rows, std::int64_t owner_key, const MapRow& head, const StateMarks& before,
                                  const MapLayersToWrite& after, EditTiles* recorder) {
  TileTotals totals = head.tiles;
  if (!head.CoversTiles()) {
    DHPMAP_ASSIGN_OR_RETURN(totals, rows.Count(owner_key));
  }
  DHPMAP_RETURN_IF_ERROR(
      WriteLayer(rows, owner_key, BlobKind::kFreeV1, DiffFreeSpace(before, after.free_space), totals, nullptr));
  DHPMAP_RETURN_IF_ERROR(
      WriteLayer(rows, owner_key, BlobKind::kVacatedV1, DiffVacated(before, after.vacated), totals, recorder));
  rows.NoteDeadBlobs();  // blobs that the recorder released
  if (totals.num_rows == static_cast<std::int64_t>(after.free_space.tiles().size() + after.vacated.tiles().size())) {
    return totals;
  }
  return FailedPrecondition("the store holds another state of the free space than the one the commit starts from")
      .WithReason("STALE_STATE");
}

Status MapLayersMaker::Add(const TileRow& row) {
  totals_.Add(row.index, row.layer, {.key = row.blob_key});
  const bool is_free = row.layer == LayerNumber(BlobKind::kFreeV1);
  if (!is_free && row.layer != LayerNumber(BlobKind::kVacatedV1)) {
    return FailedPrecondition(NameOf(row.layer, row.index) + " is of a layer unknown to this version");
  }
  if (row.is_missing) return DataLoss(NameOf(row.layer, row.index) + " is missing");
  auto tile = std::make_shared<FreeTile>();
  const Status decoded = DecodeFreeTile(is_free ? BlobKind::kFreeV1 : BlobKind::kVacatedV1, row.blob, row.index, *tile);
  if (!decoded.ok()) return {decoded.code(), NameOf(row.layer, row.index) + " " + decoded.message()};
  (is_free ? free_space_ : vacated_)->Put(row.index, std::move(tile));
  return Status::Ok();
}

Result<MapLayers> MapLayersMaker::Finish(const MapRow& map) {
  if (totals_.num_rows != map.tiles.num_rows) {
    return DataLoss("has " + std::to_string(totals_.num_rows) + " tiles, not " + std::to_string(map.tiles.num_rows));
  }
  if (map.CoversTiles() && totals_.sum != map.tiles.sum) return DataLoss("has other tiles than were stored");
  return MapLayers{free_space_, vacated_};
}

Result<MapLayers> ReadMapLayers(sqlite::Database& database, const MapRow& map) {
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::Prepare(database));
  MapLayersMaker layers;
  DHPMAP_RETURN_IF_ERROR(rows.ForEach(OwnerOfMap(map.key), [&layers](const TileRow& row) { return layers.Add(row); }));
  return layers.Finish(map);
}

}  // namespace dhpmap
