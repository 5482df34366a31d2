// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/edit_tile_writes.h"

namespace dhpmap::postgres {
namespace {

const std::string kPutEditTile =
    "INSERT INTO edit_tiles (map_key, edit_key, submap_id, x, y, z, layer, before_key, after_key) VALUES ($1, $2, $3, "
    "$4, $5, $6, $7, $8, $9) ON CONFLICT (map_key, edit_key, submap_id, x, y, z, layer) DO UPDATE SET before_key = "
    "excluded.before_key, after_key = excluded.after_key";
const std::string kOwnTilesOfEdit =
    "SELECT submap_id, x, y, z, layer, before_key, after_key FROM edit_tiles WHERE map_key = $1 AND edit_key = $2 AND "
    "submap_id = -1";

}  // namespace

const std::string& OwnTilesOfEdit() { return kOwnTilesOfEdit; }

void EditTileWrites::Fetched(Answer& rows) {
  while (rows.Next()) {
    Place place;
    place.submap_id = rows.Int();
    for (std::int32_t* axis : {&place.x, &place.y, &place.z}) *axis = static_cast<std::int32_t>(rows.Int());
    place.layer = rows.Int();
    Tile& tile = rows_[place];
    tile.before = rows.Int();
    tile.after = rows.Int();
  }
}

Status EditTileWrites::Note(std::int64_t submap_id, TileIndex index, std::int64_t layer, const StoredBlob& before,
                            const StoredBlob& after) {
  if (before.key == after.key) return Status::Ok();
  const Place place{submap_id, index.x, index.y, index.z, layer};
  const auto known = rows_.find(place);
  BlobCounts& counts = tiles_.counts();
  counts.Add(after.key, 1);
  if (known == rows_.end()) {
    counts.Add(before.key, 1);
    rows_[place] = {before.key, after.key, true};
    AddEditTile(totals_, submap_id, index, layer, before.key, after.key);
    totals_.bytes += before.bytes + after.bytes + kEditTileBytes;
    return Status::Ok();
  }
  // The stored row ends at a state in between; from now on it ends at `after`.
  Tile& tile = known->second;
  counts.Add(tile.after, -1);
  TileTotals old;
  AddEditTile(old, submap_id, index, layer, tile.before, tile.after);
  AddEditTile(totals_, submap_id, index, layer, tile.before, after.key);
  totals_.sum =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(totals_.sum) - static_cast<std::uint64_t>(old.sum));
  totals_.bytes += after.bytes - before.bytes;
  tile.after = after.key;
  tile.is_changed = true;
  return Status::Ok();
}

void EditTileWrites::NoteAll(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool are_before,
                             std::int64_t num_more) {
  totals_.bytes += blob_bytes;
  for (const TileWrites::Row& row : tiles_.RowsOf(owner_key)) {
    const std::int64_t before = are_before ? row.blob_key : 0, after = are_before ? 0 : row.blob_key;
    rows_[{id.value, row.index.x, row.index.y, row.index.z, row.layer}] = {before, after, true};
    tiles_.counts().Add(row.blob_key, num_more);
    AddEditTile(totals_, id.value, row.index, row.layer, before, after);
    totals_.bytes += kEditTileBytes;
  }
}

Status EditTileWrites::NoteNew(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool is_counted) {
  NoteAll(id, owner_key, blob_bytes, false, is_counted ? 0 : 1);
  return Status::Ok();
}

Status EditTileWrites::NoteRemoved(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes) {
  NoteAll(id, owner_key, blob_bytes, true, 1);
  return Status::Ok();
}

void EditTileWrites::Write(std::int64_t map_key, std::vector<Call>& calls) const {
  for (const auto& [place, tile] : rows_) {
    if (!tile.is_changed) continue;
    Values& values = calls.emplace_back(Call{&kPutEditTile}).values;
    values.Add(map_key).Add(edit_key_).Add(place.submap_id).Add(place.x).Add(place.y).Add(place.z).Add(place.layer);
    values.Add(tile.before).Add(tile.after);
  }
}

}  // namespace dhpmap::postgres
