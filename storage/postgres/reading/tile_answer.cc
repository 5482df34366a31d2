// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/tile_answer.h"

#include <cstdint>

namespace dhpmap::postgres {
namespace {

const std::string kSelectTiles =
    "SELECT t.owner_id, t.x, t.y, t.z, t.layer, t.blob_key, b.blob_key IS NULL, coalesce(c.num_refs, 1) > 1, "
    "coalesce(b.num_blocks, 0), t.cells, t.extent, b.blob FROM tiles t LEFT JOIN tile_blobs b ON b.map_key = t.map_key "
    "AND b.blob_key = t.blob_key LEFT JOIN blob_counts c ON c.map_key = t.map_key AND c.blob_key = t.blob_key ";
const std::string kAllTilesText = kSelectTiles + "WHERE t.map_key = $1 ORDER BY t.owner_id, t.x, t.y, t.z, t.layer";
const std::string kTilesOfOwner =
    kSelectTiles + "WHERE t.map_key = $1 AND t.owner_id = $2 ORDER BY t.x, t.y, t.z, t.layer";

}  // namespace

const std::string& AllTilesText() { return kAllTilesText; }
const std::string& TilesOfOwnerText() { return kTilesOfOwner; }

TileRow TileOf(Answer& answer) {
  TileRow row;
  for (std::int32_t* axis : {&row.index.x, &row.index.y, &row.index.z}) *axis = static_cast<std::int32_t>(answer.Int());
  row.layer = answer.Int();
  row.blob_key = answer.Int();
  row.is_missing = answer.Int() != 0;
  row.is_shared = answer.Int() != 0;
  row.num_blocks = answer.Int();
  row.cells = static_cast<std::uint64_t>(answer.Int());
  row.extent = static_cast<std::uint64_t>(answer.Int());
  row.blob = answer.Blob();
  return row;
}

}  // namespace dhpmap::postgres
