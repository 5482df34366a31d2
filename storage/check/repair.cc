// SPDX-License-Identifier: BSD-3-Clause
#include <set>
#include <string>
#include <vector>

#include "storage/check/sqlite_check.h"
#include "storage/check/sqlite_history.h"
#include "storage/codec/envelope.h"
#include "storage/history/change_history.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/rows/tile_rows.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kRepairTask[] = "repair the map";

/// Updates the row of a submap to match its readable data.
Status Reseal(Database& database, const SubmapRow& row, std::int64_t revision) {
  constexpr std::uint64_t kRepairGeneration = 1;
  Submap submap(row.info, kRepairGeneration);
  submap.mutable_info().revision = revision;
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::Prepare(database));
  TileTotals totals;
  std::vector<StoredBlob> miscounted;
  const Status read = rows.ForEach(row.key, [&](const TileRowReader::Row& stored) -> Status {
    BlockTile tile;
    DHPMAP_RETURN_IF_ERROR(FindObjectLayer(stored.layer)->decode(stored.blob, stored.index, tile));
    totals.Add(stored.index, stored.layer,
               {.key = stored.blob_key, .bytes = static_cast<std::int64_t>(stored.blob.size())});
    for (const BlockEntry& entry : tile.entries()) submap.AddLayers(entry);
    const auto num_blocks = static_cast<std::int64_t>(tile.entries().size());
    if (num_blocks != stored.num_blocks) miscounted.push_back({.key = stored.blob_key, .num_blocks = num_blocks});
    return Status::Ok();
  });
  DHPMAP_RETURN_IF_ERROR(read);
  DHPMAP_ASSIGN_OR_RETURN(Statement count,
                          database.Prepare("UPDATE tile_blobs SET num_blocks = ? WHERE blob_key = ?", kRepairTask));
  for (const StoredBlob& blob : miscounted) DHPMAP_RETURN_IF_ERROR(count.Bind(blob.num_blocks).Bind(blob.key).Run());
  DHPMAP_ASSIGN_OR_RETURN(Statement forget,  // determined again when the map is opened with paging
                          database.Prepare("UPDATE tiles SET cells = 0, extent = 0 WHERE owner_key = ?", kRepairTask));
  DHPMAP_RETURN_IF_ERROR(forget.Bind(row.key).Run());
  submap.UpdateBoundingSphere();
  SubmapCounts counts = CountBlocks(submap);
  counts.blob_bytes = totals.bytes;
  DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter writer, SubmapRowWriter::Prepare(database));
  return writer.Write(row.map_key, submap, counts, totals.sum).status();
}

/// If the TSDF is dropped, so is the whole tile: without it labels and gone counts have no meaning.
Status Drop(const BadTile& bad, TileRows& tiles) {
  DHPMAP_ASSIGN_OR_RETURN(const StoredLayers stored, tiles.Find(bad.owner_key, bad.index));
  const bool is_all = bad.layer == LayerNumber(BlobKind::kTsdfTile);
  TileTotals ignored;  // counted again after the drops
  for (std::size_t layer = 0; layer < stored.size(); ++layer) {
    const auto number = static_cast<std::int64_t>(layer);
    if (!is_all && number != bad.layer) continue;
    DHPMAP_RETURN_IF_ERROR(tiles.Erase(bad.owner_key, bad.index, number, stored[layer], ignored));
  }
  return Status::Ok();
}

/// Deletes rows without an owner, and counts the references to blobs again.
Status RepairReferences(Database& database) {
  // Rows of maps; deleting a submap deletes its tiles and its box, too.
  for (const char* table :
       {"submaps", "map_config", "label_classes", "feed_sessions", "lost_revisions", "merged_ids", "object_pairs",
        "kept_clear", "changes", "change_logs", "edits", "edit_targets", "edit_totals"}) {
    DHPMAP_RETURN_IF_ERROR(database.Execute(
        std::string("DELETE FROM ") + table + " WHERE map_key NOT IN (SELECT map_key FROM maps)", kRepairTask));
  }
  return database.Execute(
      "DELETE FROM tiles WHERE owner_key NOT IN (SELECT submap_key FROM submaps UNION ALL SELECT -map_key FROM maps);"
      "DELETE FROM submap_boxes WHERE submap_key NOT IN (SELECT submap_key FROM submaps);"
      "DELETE FROM edit_histories WHERE edit_key NOT IN (SELECT edit_key FROM edits);"
      "DELETE FROM edit_tiles WHERE edit_key NOT IN (SELECT edit_key FROM edit_histories);"
      "DELETE FROM shared_blobs; INSERT INTO shared_blobs (blob_key, num_more) SELECT blob_key, count(*) - 1 FROM "
      "blob_references GROUP BY blob_key HAVING count(*) > 1; DELETE FROM dead_blobs; INSERT INTO dead_blobs "
      "(blob_key) SELECT blob_key FROM tile_blobs EXCEPT SELECT blob_key FROM blob_references",
      kRepairTask);
}

}  // namespace

Status RepairRows(Database& database, const std::string& name, Verification& found) {
  if (found.report.num_faults == 0) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(MapRow map, ReadMap(database, name));
  DHPMAP_ASSIGN_OR_RETURN(TileRows tiles, TileRows::Prepare(database));
  DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter writer, SubmapRowWriter::Prepare(database));
  for (const BadTile& bad : found.bad_tiles) DHPMAP_RETURN_IF_ERROR(Drop(bad, tiles));
  for (const std::int64_t key : found.bad_submaps) DHPMAP_RETURN_IF_ERROR(writer.Erase(key));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> submaps, ReadSubmaps(database, map.key));
  const std::set<std::int64_t> wrong(found.wrong_submaps.begin(), found.wrong_submaps.end());
  for (const SubmapRow& row : submaps) {
    if (wrong.contains(row.key)) DHPMAP_RETURN_IF_ERROR(Reseal(database, row, map.info.revision + 1));
  }
  DHPMAP_RETURN_IF_ERROR(RepairHistory(database, map.key, found.history, found.IsStateWrong()));
  DHPMAP_RETURN_IF_ERROR(ForgetChanges(database, map.key));
  DHPMAP_RETURN_IF_ERROR(RepairReferences(database));
  DHPMAP_ASSIGN_OR_RETURN(map.tiles, tiles.Count(OwnerOfMap(map.key)));
  map.num_submaps = static_cast<std::int64_t>(submaps.size());
  const bool is_leaving_there = std::any_of(submaps.begin(), submaps.end(), [&map](const SubmapRow& row) {
    return std::int64_t{row.info.id.value} == map.leaving_id;
  });
  if (!is_leaving_there) map.leaving_id = -1;
  DHPMAP_RETURN_IF_ERROR(WriteRepairedMap(database, map));
  found.report.is_repaired = true;
  found.report.revision = map.info.revision;
  return Status::Ok();
}

}  // namespace dhpmap
