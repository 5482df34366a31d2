// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/tile_writes.h"

#include <bit>
#include <limits>
#include <string>
#include <utility>

#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

const std::string kCountBlobs =
    "INSERT INTO blob_counts AS c (map_key, blob_key, num_refs, since_ns) SELECT $1, d.blob_key, 1 + d.num, $4 FROM "
    "unnest($2, $3) AS d (blob_key, num) ON CONFLICT (map_key, blob_key) DO UPDATE SET num_refs = c.num_refs + "
    "excluded.num_refs - 1, since_ns = excluded.since_ns";
const std::string kInsertBlob = "INSERT INTO tile_blobs (blob_key, num_blocks, blob, map_key) VALUES ($1, $2, $3, $4)";
const std::string kPutTile =
    "INSERT INTO tiles (map_key, owner_id, x, y, z, layer, blob_key, num_bytes, cells, extent) VALUES ($1, $2, $3, $4, "
    "$5, $6, $7, $8, $9, $10) ON CONFLICT (map_key, owner_id, x, y, z, layer) DO UPDATE SET blob_key = "
    "excluded.blob_key, num_bytes = excluded.num_bytes, cells = excluded.cells, extent = excluded.extent";
const std::string kEraseTile =
    "DELETE FROM tiles WHERE map_key = $1 AND owner_id = $2 AND x = $3 AND y = $4 AND z = $5 AND layer = $6";
const std::string kEraseOwner = "DELETE FROM tiles WHERE map_key = $1 AND owner_id = $2";
const std::string kEraseSubmap = "DELETE FROM submaps WHERE map_key = $1 AND submap_id = $2";

}  // namespace

const std::string& TilesByPlace() {
  // OFFSET 0: one look-up by key for each, whatever the planner believes of their number.
  static const std::string text =
      "SELECT t.owner_id, t.x, t.y, t.z, t.layer, t.blob_key, t.num_bytes, t.cells, t.extent FROM unnest($2, $3, $4, "
      "$5) "
      "AS w (owner_id, x, y, z) CROSS JOIN LATERAL (SELECT * FROM tiles s WHERE s.map_key = $1 AND s.owner_id = "
      "w.owner_id AND s.x = w.x AND s.y = w.y AND s.z = w.z OFFSET 0) t";
  return text;
}

const std::string& TilesByOwner() {
  static const std::string text =
      "SELECT owner_id, x, y, z, layer, blob_key, num_bytes, cells, extent FROM tiles WHERE map_key = $1 AND owner_id "
      "= "
      "ANY ($2)";
  return text;
}

const std::string& SubmapsById() {
  static const std::string text = SelectText(Submaps(), "WHERE map_key = $1 AND submap_id = ANY ($2)");
  return text;
}

const std::string& BlobsByKey() {
  static const std::string text =
      "SELECT blob_key, num_blocks, octet_length(blob) FROM tile_blobs WHERE map_key = $1 AND blob_key = ANY ($2)";
  return text;
}

void BlobCounts::Write(std::int64_t map_key, std::int64_t now_ns, std::vector<Call>& calls) const {
  std::vector<std::int64_t> keys, numbers;
  for (const auto& [key, number] : changes_) {
    if (number == 0) continue;
    keys.push_back(key);
    numbers.push_back(number);
  }
  if (keys.empty()) return;
  Call& call = calls.emplace_back(Call{&kCountBlobs});
  call.values.Add(map_key).Add(std::span<const std::int64_t>(keys)).Add(std::span<const std::int64_t>(numbers));
  call.values.Add(now_ns);
}

void TileWrites::Fetched(Answer& tiles) {
  while (tiles.Next()) {
    Place place;
    place.owner = tiles.Int();
    for (std::int32_t* axis : {&place.x, &place.y, &place.z}) *axis = static_cast<std::int32_t>(tiles.Int());
    place.layer = tiles.Int();
    Tile tile{.blob = {.key = tiles.Int()}, .is_stored = true};
    tile.blob.bytes = tiles.Int();
    tile.blob.cells = static_cast<std::uint64_t>(tiles.Int());
    tile.blob.extent = static_cast<std::uint64_t>(tiles.Int());
    tile.blob.num_blocks = std::popcount(tile.blob.cells);
    tiles_[place] = tile;
  }
}

void TileWrites::FetchedBlobs(Answer& blobs) {
  while (blobs.Next()) {
    StoredBlob blob{.key = blobs.Int()};
    blob.num_blocks = blobs.Int();
    blob.bytes = blobs.Int();
    blobs_[blob.key] = blob;
  }
}

TileWrites::Tiles::const_iterator TileWrites::FirstOf(std::int64_t owner) const {
  constexpr auto kFirst = std::numeric_limits<std::int32_t>::min();
  return tiles_.lower_bound({owner, kFirst, kFirst, kFirst, 0});
}

Result<StoredLayers> TileWrites::Find(std::int64_t owner_key, TileIndex index) {
  StoredLayers layers{};
  for (auto tile = tiles_.lower_bound(PlaceOf(owner_key, index, 0)); tile != tiles_.end(); ++tile) {
    const Place& place = tile->first;
    if (place.owner != owner_key || TileIndex{place.x, place.y, place.z} != index) break;
    const auto layer = static_cast<std::uint64_t>(place.layer);
    if (layer < layers.size()) layers[layer] = tile->second.blob;
  }
  return layers;
}

Result<TileTotals> TileWrites::Count(std::int64_t) {
  return Internal("every row of this store has a sum of its tiles");
}

Result<StoredBlob> TileWrites::Insert(ByteView blob, std::int64_t num_blocks) {
  const StoredBlob stored{
      .key = next_blob_key_++, .num_blocks = num_blocks, .bytes = static_cast<std::int64_t>(blob.size())};
  Call& call = blob_calls_.emplace_back(Call{&kInsertBlob});
  call.values.Add(stored.key).Add(num_blocks).Add(blob);
  blobs_[stored.key] = stored;
  return stored;
}

Result<std::optional<StoredBlob>> TileWrites::Share(std::int64_t blob_key) {
  const auto found = blobs_.find(blob_key);
  if (found == blobs_.end()) return std::optional<StoredBlob>();
  counts_.Add(blob_key, 1);
  return std::optional(found->second);
}

void TileWrites::Set(std::int64_t owner, TileIndex index, std::int64_t layer, const StoredBlob& blob) {
  Tile& tile = tiles_[PlaceOf(owner, index, layer)];
  tile.blob = blob;
  tile.is_changed = true;
}

Status TileWrites::Copy(std::int64_t from_owner_key, std::int64_t to_owner_key, std::int64_t num_more) {
  std::vector<std::pair<Place, StoredBlob>> copied;
  for (auto tile = FirstOf(from_owner_key); tile != tiles_.end() && tile->first.owner == from_owner_key; ++tile) {
    if (tile->second.blob.key != 0) copied.emplace_back(tile->first, tile->second.blob);
  }
  for (const auto& [place, blob] : copied) {
    Set(to_owner_key, {place.x, place.y, place.z}, place.layer, blob);
    counts_.Add(blob.key, num_more);
  }
  return Status::Ok();
}

Status TileWrites::Put(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
                       const StoredBlob& after, TileTotals& totals) {
  totals.Add(index, layer, after);
  if (before.key != 0) {
    totals.Remove(index, layer, before);
    counts_.Add(before.key, -1);
  }
  Set(owner_key, index, layer, after);
  return Status::Ok();
}

Status TileWrites::Erase(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
                         TileTotals& totals) {
  if (before.key == 0) return Status::Ok();
  totals.Remove(index, layer, before);
  counts_.Add(before.key, -1);
  Set(owner_key, index, layer, StoredBlob());
  return Status::Ok();
}

void TileWrites::EraseAll(std::int64_t owner_key) {
  erased_owners_.push_back(owner_key);
  auto tile = FirstOf(owner_key);
  while (tile != tiles_.end() && tile->first.owner == owner_key) {
    counts_.Add(tile->second.blob.key, -1);
    tile = tiles_.erase(tile);
  }
}

std::vector<TileWrites::Row> TileWrites::RowsOf(std::int64_t owner_key) const {
  std::vector<Row> rows;
  for (auto tile = FirstOf(owner_key); tile != tiles_.end() && tile->first.owner == owner_key; ++tile) {
    const Place& place = tile->first;
    if (tile->second.blob.key == 0) continue;
    rows.push_back({{place.x, place.y, place.z}, place.layer, tile->second.blob.key});
  }
  return rows;
}

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

void SubmapWrites::Fetched(Answer& submaps) {
  while (submaps.Next()) {
    SubmapRow row;
    (void)ReadRow(Submaps(), submaps, row);  // a damaged row is written anew, as the state in memory is whole
    stored_[row.info.id.value] = row;
  }
}

Result<std::optional<SubmapTable::Stored>> SubmapWrites::Find(std::int64_t, SubmapId id) {
  const auto found = stored_.find(id.value);
  if (found == stored_.end()) return std::optional<Stored>();
  const SubmapRow& row = found->second;
  return std::optional(Stored{std::int64_t{id.value}, row.counts, row.tiles_sum, row.CoversTiles()});
}

Result<std::int64_t> SubmapWrites::Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                                         std::int64_t tiles_sum) {
  const std::int64_t key = submap.id().value;
  written_[key] = SubmapRowOf(map_key, submap, counts, tiles_sum);
  return key;
}

Status SubmapWrites::Erase(std::int64_t submap_key) {
  erased_.push_back(submap_key);
  tiles_.EraseAll(submap_key);
  return Status::Ok();
}

void SubmapWrites::Write(std::int64_t map_key, std::vector<Call>& calls) const {
  static const std::string upsert = UpsertText(Submaps());
  for (const std::int64_t id : erased_) calls.emplace_back(Call{&kEraseSubmap}).values.Add(map_key).Add(id);
  for (const auto& entry : written_) Submaps().BindAll(entry.second, calls.emplace_back(Call{&upsert}).values);
}

void SubmapWrites::AddTo(CommitPlaces& places) const {
  for (const std::int64_t id : erased_) places.AddRow(id);
  for (const auto& entry : written_) places.AddRow(entry.first);
}

}  // namespace dhpmap::postgres
