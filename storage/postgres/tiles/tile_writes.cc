// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/tiles/tile_writes.h"

#include <bit>
#include <limits>
#include <string>
#include <utility>

namespace dhpmap::postgres {
namespace {

const std::string kInsertBlob = "INSERT INTO tile_blobs (blob_key, num_blocks, blob, map_key) VALUES ($1, $2, $3, $4)";

}  // namespace

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

}  // namespace dhpmap::postgres
