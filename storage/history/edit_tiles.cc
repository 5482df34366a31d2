// SPDX-License-Identifier: BSD-3-Clause
#include "storage/history/edit_tiles.h"

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "storage/codec/edit_codec.h"
#include "storage/codec/free_codec.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {
namespace {

/// One side of the tiles of a delta, layer by layer.
class TileSide {
 public:
  explicit TileSide(std::uint16_t store) : store_(store) {}

  Status Add(const ObjectLayer& layer, TileIndex index, std::int64_t key, ByteView blob,
             std::shared_ptr<const BlockTile>& side) const {
    if (key == 0) return Status::Ok();
    if (blob.empty()) return DataLoss("is missing");
    // Created here, and not shared yet.
    auto tile = side != nullptr ? std::const_pointer_cast<BlockTile>(side) : std::make_shared<BlockTile>();
    DHPMAP_RETURN_IF_ERROR(layer.decode(blob, index, *tile));
    tile->stored(layer.layer).Set(store_, key);
    side = std::move(tile);
    return Status::Ok();
  }

 private:
  std::uint16_t store_;
};

Status AddVacated(const EditTileRow& row, StateDelta& delta) {
  VacatedDelta tile{.index = row.index, .before = nullptr, .after = nullptr};
  for (const auto& [key, blob, side] :
       {std::tuple(row.before_key, row.before, &tile.before), std::tuple(row.after_key, row.after, &tile.after)}) {
    if (key == 0) continue;
    auto decoded = std::make_shared<FreeTile>();
    DHPMAP_RETURN_IF_ERROR(DecodeFreeTile(BlobKind::kVacatedV1, blob, row.index, *decoded));
    *side = std::move(decoded);
  }
  delta.vacated.push_back(std::move(tile));
  return Status::Ok();
}

}  // namespace

EditTileRow ReadEditTileRow(RowColumns& columns) {
  EditTileRow row;
  row.submap_id = columns.Int();
  for (std::int32_t* coordinate : {&row.index.x, &row.index.y, &row.index.z}) {
    *coordinate = static_cast<std::int32_t>(columns.Int());
  }
  row.layer = columns.Int();
  row.before_key = columns.Int();
  row.after_key = columns.Int();
  return row;
}

Status AddEditTileTo(const EditTileRow& row, std::uint16_t store, StateDelta& delta) {
  if (row.submap_id == kMapsOwnTiles && row.layer == LayerNumber(BlobKind::kVacatedV1)) return AddVacated(row, delta);
  const auto submap = std::lower_bound(
      delta.submaps.begin(), delta.submaps.end(), row.submap_id,
      [](const SubmapDelta& s, std::int64_t id) { return static_cast<std::int64_t>(s.id.value) < id; });
  const ObjectLayer* layer = FindObjectLayer(row.layer);
  const bool is_named = submap != delta.submaps.end() && std::int64_t{submap->id.value} == row.submap_id;
  if (!is_named || layer == nullptr) return DataLoss("is of an object or layer that it does not name");
  if (submap->tiles.empty() || submap->tiles.back().index != row.index) {
    submap->tiles.push_back({.index = row.index, .differs = {}, .before = nullptr, .after = nullptr});
  }
  TileDelta& tile = submap->tiles.back();
  tile.differs[static_cast<std::size_t>(layer->layer)] = true;
  const TileSide side(store);
  DHPMAP_RETURN_IF_ERROR(side.Add(*layer, row.index, row.before_key, row.before, tile.before));
  return side.Add(*layer, row.index, row.after_key, row.after, tile.after);
}

void AddEditTile(TileTotals& totals, std::int64_t submap_id, TileIndex index, std::int64_t layer,
                 std::int64_t before_key, std::int64_t after_key) {
  constexpr std::int64_t kLayersAnOwner = 256;
  totals.Add(index, submap_id * kLayersAnOwner + layer, {.key = before_key});
  totals.Add(index, ~(submap_id * kLayersAnOwner + layer), {.key = after_key});
}

Status DamagedHistory(const MapRow& map, std::int64_t revision, const std::string& what) {
  return DataLoss("map '" + map.info.name + "': what undoes edit " + std::to_string(revision) + " " + what)
      .WithReason("DAMAGED_EDITS");
}

Status UndoNotKept(std::int64_t revision, std::optional<std::int64_t> oldest_edit) {
  Status status = FailedPrecondition("what it takes to undo edit " + std::to_string(revision) + " is not kept" +
                                     (oldest_edit ? ", but from edit " + std::to_string(*oldest_edit) + " on" : ""))
                      .WithReason("UNDO_NOT_KEPT");
  return oldest_edit ? std::move(status).WithMetadata("oldest_edit", std::to_string(*oldest_edit)) : status;
}

EditHistoryRow EditHistoryRowOf(std::int64_t map_key, std::int64_t edit_key, const EditRecord& edit,
                                const MapSnapshot& after, const EditTileSums& tiles) {
  EditHistoryRow row{.key = edit_key,
                     .map_key = map_key,
                     .revision = edit.entry.revision,
                     .time_ns = edit.entry.time_ns,
                     .num_bytes = tiles.num_bytes,
                     .tiles_sum = tiles.sum,
                     .blob = {EncodeEditRows(DiffRows(*edit.before, after), edit.entry.revision)},
                     .seal = {}};
  row.num_bytes += static_cast<std::int64_t>(row.blob.bytes.size());
  row.seal = EditHistories().SealOf(row);
  return row;
}

}  // namespace dhpmap
