// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/check/repair_tiles.h"

#include <string>
#include <utility>

#include "storage/codec/envelope.h"

namespace dhpmap::postgres {
namespace {

const std::string kDropTile =
    "DELETE FROM tiles WHERE map_key = $1 AND owner_id = $2 AND x = $3 AND y = $4 AND z = $5 AND (layer = $6 OR $7 <> "
    "0)";
const std::string kDropSubmap = "DELETE FROM submaps WHERE map_key = $1 AND submap_id = $2";
const std::string kDropStrayTiles =
    "DELETE FROM tiles WHERE map_key = $1 AND owner_id >= 0 AND owner_id NOT IN (SELECT s.submap_id FROM submaps s "
    "WHERE "
    "s.map_key = $1)";
const std::string kSizeTiles =
    "UPDATE tiles t SET num_bytes = octet_length(b.blob) FROM tile_blobs b WHERE t.map_key = $1 AND b.map_key = "
    "t.map_key AND b.blob_key = t.blob_key AND t.num_bytes <> octet_length(b.blob)";
const std::string kForgetCounts = "DELETE FROM blob_counts WHERE map_key = $1";
const std::string kCountAnew =
    "INSERT INTO blob_counts (map_key, blob_key, num_refs, since_ns) SELECT $1, b.blob_key, coalesce(r.n, 0), $2 FROM "
    "tile_blobs b LEFT JOIN (SELECT a.blob_key, count(*) AS n FROM (SELECT blob_key FROM tiles WHERE map_key = $1 "
    "UNION "
    "ALL SELECT before_key FROM edit_tiles WHERE map_key = $1 UNION ALL SELECT after_key FROM edit_tiles WHERE map_key "
    "= "
    "$1) a GROUP BY a.blob_key) r ON r.blob_key = b.blob_key WHERE b.map_key = $1 AND coalesce(r.n, 0) <> 1";
/// Rows that belong to no map are swept as those of a removed map.
const std::string kRemoveLost =
    "INSERT INTO removed_maps (map_key) SELECT k.map_key FROM (SELECT map_key FROM map_config UNION SELECT map_key "
    "FROM "
    "submaps) k WHERE NOT EXISTS (SELECT 1 FROM maps m WHERE m.map_key = k.map_key) AND NOT EXISTS (SELECT 1 FROM "
    "incoming_maps m WHERE m.map_key = k.map_key) ON CONFLICT DO NOTHING";

Call CallFor(const std::string& text, std::int64_t map_key) {
  Call call{&text};
  call.values.Add(map_key);
  return call;
}

}  // namespace

std::vector<Call> CallsToDrop(std::int64_t map_key, const Verification& found) {
  std::vector<Call> calls;
  for (const BadTile& bad : found.bad_tiles) {
    // Without its TSDF a tile is deleted whole: its labels and gone voxels then have no meaning.
    const bool is_all = bad.layer == LayerNumber(BlobKind::kTsdfTile);
    Values& values = calls.emplace_back(CallFor(kDropTile, map_key)).values;
    values.Add(bad.owner_key).Add(bad.index.x).Add(bad.index.y).Add(bad.index.z).Add(bad.layer).Add(is_all ? 1 : 0);
  }
  for (const std::int64_t id : found.bad_submaps) {
    calls.emplace_back(CallFor(kDropSubmap, map_key)).values.Add(id);
  }
  calls.push_back(CallFor(kDropStrayTiles, map_key));
  calls.push_back(CallFor(kSizeTiles, map_key));
  return calls;
}

std::vector<Call> CallsToCount(std::int64_t map_key, std::int64_t now_ns) {
  Call count = CallFor(kCountAnew, map_key);
  count.values.Add(now_ns);
  return {CallFor(kForgetCounts, map_key), std::move(count), {&kRemoveLost}};
}

}  // namespace dhpmap::postgres
