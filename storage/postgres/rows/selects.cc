// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/rows/selects.h"

#include "storage/postgres/rows/table_text.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {

const std::string& TilesByPlace() {
  // OFFSET 0: the planner must look each key up by the index, however many it expects.
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

}  // namespace dhpmap::postgres
