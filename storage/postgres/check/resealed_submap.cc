// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/check/resealed_submap.h"

#include <string>

#include "storage/postgres/rows/table_text.h"
#include "storage/rows/submap_rows.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap::postgres {
namespace {

/// The only change to a blob's row. No reader accepted it with the wrong number.
const std::string kCountBlocks = "UPDATE tile_blobs SET num_blocks = $3 WHERE map_key = $1 AND blob_key = $2";
const std::string kSayTile =
    "UPDATE tiles SET cells = $7, extent = $8 WHERE map_key = $1 AND owner_id = $2 AND x = $3 AND y = $4 AND z = $5 "
    "AND "
    "layer = $6";

}  // namespace

Result<std::vector<Call>> ResealedSubmap(RowsToVerify& rows, const SubmapRow& row, std::int64_t revision) {
  constexpr std::uint64_t kRepairGeneration = 1;
  static const std::string upsert = UpsertText(Submaps());
  std::vector<Call> calls;
  Submap submap(row.info, kRepairGeneration);
  submap.mutable_info().revision = revision;
  TileTotals totals;
  const Status read = rows.ForEachTile(row.key, [&](const TileRow& stored) -> Status {
    const ObjectLayer& layer = *FindObjectLayer(stored.layer);
    BlockTile tile;
    DHPMAP_RETURN_IF_ERROR(layer.decode(stored.blob, stored.index, tile));
    totals.Add(stored.index, stored.layer,
               {.key = stored.blob_key, .bytes = static_cast<std::int64_t>(stored.blob.size())});
    for (const BlockEntry& entry : tile.entries()) submap.AddLayers(entry);
    const auto num_blocks = static_cast<std::int64_t>(tile.entries().size());
    if (num_blocks != stored.num_blocks) {
      calls.emplace_back(Call{&kCountBlocks}).values.Add(row.map_key).Add(stored.blob_key).Add(num_blocks);
    }
    const std::uint64_t extent = layer.layer == BlockLayer::kTsdf ? tile.Extent().Code() : 0;
    if (stored.cells == tile.cells() && stored.extent == extent) return Status::Ok();
    Values& values = calls.emplace_back(Call{&kSayTile}).values;
    values.Add(row.map_key).Add(row.key).Add(stored.index.x).Add(stored.index.y).Add(stored.index.z).Add(stored.layer);
    values.Add(static_cast<std::int64_t>(tile.cells())).Add(static_cast<std::int64_t>(extent));
    return Status::Ok();
  });
  DHPMAP_RETURN_IF_ERROR(read);
  submap.UpdateBoundingSphere();
  SubmapCounts counts = CountBlocks(submap);
  counts.blob_bytes = totals.bytes;
  const SubmapRow resealed = SubmapRowOf(row.map_key, submap, counts, totals.sum);
  Submaps().BindAll(resealed, calls.emplace_back(Call{&upsert}).values);
  return calls;
}

}  // namespace dhpmap::postgres
