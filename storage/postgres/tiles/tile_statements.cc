// SPDX-License-Identifier: BSD-3-Clause
// The statements that TileWrites adds to a commit.
#include <string>
#include <utility>

#include "storage/postgres/tiles/tile_writes.h"

namespace dhpmap::postgres {
namespace {

const std::string kPutTile =
    "INSERT INTO tiles (map_key, owner_id, x, y, z, layer, blob_key, num_bytes, cells, extent) VALUES ($1, $2, $3, $4, "
    "$5, $6, $7, $8, $9, $10) ON CONFLICT (map_key, owner_id, x, y, z, layer) DO UPDATE SET blob_key = "
    "excluded.blob_key, num_bytes = excluded.num_bytes, cells = excluded.cells, extent = excluded.extent";
const std::string kEraseTile =
    "DELETE FROM tiles WHERE map_key = $1 AND owner_id = $2 AND x = $3 AND y = $4 AND z = $5 AND layer = $6";
const std::string kEraseOwner = "DELETE FROM tiles WHERE map_key = $1 AND owner_id = $2";

}  // namespace

void TileWrites::Write(std::int64_t map_key, std::int64_t now_ns, std::vector<Call>& calls) {
  for (Call& blob : blob_calls_) {
    blob.values.Add(map_key);
    calls.push_back(std::move(blob));
  }
  for (const std::int64_t owner : erased_owners_) {
    calls.emplace_back(Call{&kEraseOwner}).values.Add(map_key).Add(owner);
  }
  for (const auto& [place, tile] : tiles_) {
    if (!tile.IsToBeWritten()) continue;
    const bool is_erased = tile.blob.key == 0;
    Values& values = calls.emplace_back(Call{is_erased ? &kEraseTile : &kPutTile}).values;
    values.Add(map_key).Add(place.owner).Add(place.x).Add(place.y).Add(place.z).Add(place.layer);
    if (is_erased) continue;
    values.Add(tile.blob.key).Add(tile.blob.bytes).Add(static_cast<std::int64_t>(tile.blob.cells));
    values.Add(static_cast<std::int64_t>(tile.blob.extent));
  }
  counts_.Write(map_key, now_ns, calls);
}

void TileWrites::AddTo(CommitPlaces& places) const {
  for (const std::int64_t owner : erased_owners_) places.Empty(owner);
  for (const auto& [place, tile] : tiles_) {
    if (tile.IsToBeWritten()) places.AddTile(place.owner, {place.x, place.y, place.z}, place.layer);
  }
}

}  // namespace dhpmap::postgres
