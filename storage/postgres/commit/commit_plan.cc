// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/commit_plan.h"

#include <algorithm>
#include <string>

#include "storage/paging/map_layers.h"
#include "storage/postgres/rows/part_writes.h"
#include "storage/postgres/tiles/tile_owner.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

const std::string kCollectDead =
    "WITH dead AS (DELETE FROM blob_counts WHERE map_key = $1 AND num_refs <= 0 AND blob_key IN "
    "(SELECT c.blob_key FROM blob_counts c WHERE c.map_key = $1 AND c.num_refs <= 0 AND c.since_ns < $2 "
    "ORDER BY c.since_ns LIMIT $3) RETURNING blob_key) "
    "DELETE FROM tile_blobs USING dead WHERE tile_blobs.map_key = $1 AND tile_blobs.blob_key = dead.blob_key";

/// The row for a state and its stored layers, sealed with the parts of that state.
MapRow RowAfter(const MapRow& before, const MapSnapshot& after, const TileTotals& tiles, bool lacks_left,
                const MapParts& parts_before, const MapParts& parts) {
  MapRow row = MapRowOf(after);
  row.key = before.key;
  row.tiles = tiles;
  if (lacks_left && after.leaving()) row.leaving_id = std::int64_t{after.leaving()->value};
  row.marks = before.marks;
  RaiseMarks(row);
  SealMapParts(row, parts);
  // Stored rows may include retired keys at their defaults, which were not loaded.
  if (IsSameConfig(parts_before, parts)) row.config_checksum = before.config_checksum;
  SealMapRow(row);
  return row;
}

/// Deletes more unused blobs than the commit wrote, so their number stays bounded; but not many more, so that no commit
/// takes long.
void CollectDead(std::int64_t map_key, std::int64_t now_ns, std::int64_t num_written, const KeepingLimits& limits,
                 std::vector<Call>& calls) {
  const auto before_ns = now_ns - static_cast<std::int64_t>(limits.dead_grace_s * 1e9);
  const std::int64_t num = std::min<std::int64_t>(16 + 2 * num_written, 512);
  calls.emplace_back(Call{&kCollectDead}).values.Add(map_key).Add(before_ns).Add(num);
}

}  // namespace

Result<WrittenTiles> CommitPlan::Make(const MapParts& parts_before, MapHead& head, std::vector<Call>& calls) {
  const EditRecord* const edit = request_.edit;
  const MapSnapshot& after = request_.after;
  if (edit != nullptr) state_.edits.Record(map_.key, *edit, now_ns_, limits_.edits, calls);
  // The undo data of an undo are kept with the edit that it undid.
  const bool is_kept =
      edit != nullptr && edit->entry.summary.kind == EditKind::kEdit && limits_.edits.max_histories > 0;
  EditTiles* const objects = is_kept ? &own_tiles_ : nullptr;
  EditTiles* const layers = edit == nullptr && state_.left ? &*state_.left : objects;
  const bool lacks_left = edit != nullptr;
  const MapLayersToWrite to_write{*after.free_space(), lacks_left ? *after.noted_vacated() : *after.vacated()};
  DHPMAP_ASSIGN_OR_RETURN(const TileTotals tiles,
                          WriteMapLayers(state_.tiles, kMapsOwner, head.row, request_.before, to_write, layers));
  DHPMAP_ASSIGN_OR_RETURN(WrittenTiles written,
                          WriteChanges(state_.submaps, state_.tiles, map_.key, changes_, map_.number, pool_, objects));
  const MapParts parts = MapPartsOf(map_.key, after.info());
  head.row = RowAfter(head.row, after, tiles, lacks_left, parts_before, parts);
  WriteParts(parts_before, parts, calls);
  WriteLogs(is_kept, calls);
  state_.tiles.Write(map_.key, now_ns_, calls);
  state_.submaps.Write(map_.key, calls);
  head.next_blob_key = state_.tiles.next_blob_key();
  head.seen_ns = now_ns_;
  CollectDead(map_.key, now_ns_, state_.tiles.num_blobs(), limits_, calls);
  return written;
}

void CommitPlan::WriteLogs(bool is_kept, std::vector<Call>& calls) {
  const EditRecord* const edit = request_.edit;
  if (request_.before.revision() != request_.after.revision()) {
    const std::vector<RegionEvent> cleared = edit != nullptr ? edit->cleared : std::vector<RegionEvent>();
    const MapChange change = DescribeChange(request_.before, request_.after, changes_, cleared);
    state_.changes.Write(map_.key, request_.after.info(), change, now_ns_, limits_.changes, calls);
  }
  if (is_kept) {
    const EditHistoryRow row =
        EditHistoryRowOf(map_.key, own_tiles_.edit_key(), *edit, request_.after, own_tiles_.sums());
    state_.edits.Keep(row, now_ns_, own_tiles_, calls);
  }
  const bool goes_on = edit == nullptr && state_.left && state_.last_history;
  if (goes_on) state_.edits.GoOn(*state_.last_history, now_ns_, *state_.left, calls);
  if (edit != nullptr || goes_on) state_.edits.Finish(map_.key, now_ns_, limits_.edits, calls);
}

}  // namespace dhpmap::postgres
