// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/commit.h"

#include <algorithm>
#include <utility>

#include "storage/paging/map_layers.h"
#include "storage/postgres/rows/row_diff.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

const std::string kBegin = "BEGIN";
const std::string kCommit = "COMMIT";
const std::string kNameMap = "INSERT INTO map_names (name, map_key) VALUES ($1, $2)";
const std::string kCollectDead =
    "WITH dead AS (DELETE FROM blob_counts WHERE map_key = $1 AND num_refs <= 0 AND blob_key IN (SELECT c.blob_key "
    "FROM "
    "blob_counts c WHERE c.map_key = $1 AND c.num_refs <= 0 AND c.since_ns < $2 ORDER BY c.since_ns LIMIT $3) "
    "RETURNING "
    "blob_key) DELETE FROM tile_blobs USING dead WHERE tile_blobs.map_key = $1 AND tile_blobs.blob_key = dead.blob_key";
const std::string kPutPlaces = "INSERT INTO commit_places (map_key, commit_id, places) VALUES ($1, $2, $3)";
const std::string kDeleteConfig = "DELETE FROM map_config WHERE map_key = $1";
const std::string kTrimPlaces = "DELETE FROM commit_places WHERE map_key = $1 AND commit_id <= $2";

bool IsSameConfig(const MapParts& a, const MapParts& b) { return ConfigChecksum(a.config) == ConfigChecksum(b.config); }

/// The row that follows from a state and what is stored of its layers. Its parts are sealed as they are after it.
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

/// In place of all that is stored, retired keys included.
void WriteConfig(const std::vector<ConfigRow>& rows, std::vector<Call>& calls) {
  static const std::string insert = InsertText(ConfigTable());
  calls.emplace_back(Call{&kDeleteConfig}).values.Add(rows.front().map_key);
  for (const ConfigRow& row : rows) ConfigTable().BindAll(row, calls.emplace_back(Call{&insert}).values);
}

void WriteParts(const MapParts& before, const MapParts& after, std::vector<Call>& calls) {
  if (!IsSameConfig(before, after)) WriteConfig(after.config, calls);
  WriteDiff(Classes(), before.classes, after.classes, calls);
  WriteDiff(Sessions(), before.sessions, after.sessions, calls);
  WriteDiff(MergedTable(), before.merged, after.merged, calls);
  WriteDiff(PairTable(), before.pairs, after.pairs, calls);
  WriteDiff(KeptClearTable(), before.kept_clear, after.kept_clear, calls);
}

/// More than the commit wrote, so that their number stays bounded under continuous commits, and not many more, so that
/// none takes long.
void CollectDead(std::int64_t map_key, std::int64_t now_ns, std::int64_t num_written, const KeepingLimits& limits,
                 std::vector<Call>& calls) {
  const auto before_ns = now_ns - static_cast<std::int64_t>(limits.dead_grace_s * 1e9);
  const std::int64_t num = std::min<std::int64_t>(16 + 2 * num_written, 512);
  calls.emplace_back(Call{&kCollectDead}).values.Add(map_key).Add(before_ns).Add(num);
}

/// For who follows the map. Old ones go with some commits alone: a prime number, so that no rhythm of commits that have
/// no places misses them for ever.
void WritePlaces(const MapHead& head, const FetchedState& state, std::vector<Call>& calls) {
  constexpr std::int64_t kCommitsATrim = 61;
  CommitPlaces places;
  state.tiles.AddTo(places);
  state.submaps.AddTo(places);
  calls.emplace_back(Call{&kPutPlaces}).values.Add(head.row.key).Add(head.commit_id).Add(ByteView(places.Encode()));
  if (head.commit_id % kCommitsATrim != 0) return;
  calls.emplace_back(Call{&kTrimPlaces}).values.Add(head.row.key).Add(head.commit_id - CommitPlaces::kNumKept);
}

/// Plans one commit.
class Planner {
 public:
  Planner(const CommitRequest& request, const std::vector<SubmapTileChange>& changes, const OwnedMap& map,
          const KeepingLimits& limits, ThreadPool& pool, FetchedState& state)
      : request_(request),
        changes_(changes),
        map_(map),
        limits_(limits),
        pool_(pool),
        state_(state),
        now_ns_(map.Now_ns()),
        own_tiles_(request.after.revision(), state.tiles) {}

  /// Everything but the head's row, BEGIN and COMMIT.
  Result<WrittenTiles> Plan(const MapParts& parts_before, MapHead& head, std::vector<Call>& calls) {
    const EditRecord* const edit = request_.edit;
    const MapSnapshot& after = request_.after;
    if (edit != nullptr) state_.edits.Record(map_.key, *edit, now_ns_, limits_.edits, calls);
    // What undoes an undo is kept with the edit that it undid.
    const bool is_kept =
        edit != nullptr && edit->entry.summary.kind == EditKind::kEdit && limits_.edits.max_histories > 0;
    EditTiles* const objects = is_kept ? &own_tiles_ : nullptr;
    EditTiles* const layers = edit == nullptr && state_.left ? &*state_.left : objects;
    const bool lacks_left = edit != nullptr;
    const MapLayersToWrite to_write{*after.free_space(), lacks_left ? *after.noted_vacated() : *after.vacated()};
    DHPMAP_ASSIGN_OR_RETURN(const TileTotals tiles,
                            WriteMapLayers(state_.tiles, kMapsOwner, head.row, request_.before, to_write, layers));
    DHPMAP_ASSIGN_OR_RETURN(WrittenTiles written, WriteChanges(state_.submaps, state_.tiles, map_.key, changes_,
                                                               map_.number, pool_, objects));
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

 private:
  void WriteLogs(bool is_kept, std::vector<Call>& calls) {
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

  const CommitRequest& request_;
  const std::vector<SubmapTileChange>& changes_;
  const OwnedMap& map_;
  const KeepingLimits& limits_;
  ThreadPool& pool_;
  FetchedState& state_;
  const std::int64_t now_ns_;
  EditTileWrites own_tiles_;
};

}  // namespace

const std::string& BeginText() { return kBegin; }
const std::string& CommitText() { return kCommit; }

Result<CommitStatements> StatementsOf(const CommitRequest& request, const std::vector<SubmapTileChange>& changes,
                                      const OwnedMap& map, const KeepingLimits& limits, ThreadPool& pool,
                                      FetchedState& state) {
  if (request.edit != nullptr && request.before.lacks_left()) {
    return FailedPrecondition("the edit before left something").WithReason("STALE_STATE");
  }
  CommitStatements statements;
  std::vector<Call> body;
  MapHead head = state.head;
  ++head.commit_id;
  DHPMAP_ASSIGN_OR_RETURN(
      statements.written,
      Planner(request, changes, map, limits, pool, state).Plan(MapPartsOf(map.key, request.before.info()), head, body));
  WritePlaces(head, state, body);
  statements.calls.reserve(body.size() + 3);
  statements.calls.push_back({&kBegin});
  statements.calls.push_back(ReplaceHead(state.head, head));
  std::move(body.begin(), body.end(), std::back_inserter(statements.calls));
  statements.calls.push_back({&kCommit});
  return statements;
}

Result<CommitStatements> StatementsOfNew(const MapSnapshot& snapshot, const OwnedMap& map, std::int64_t owner,
                                         const KeepingLimits& limits, ThreadPool& pool) {
  CommitStatements statements;
  std::vector<Call>& calls = statements.calls;
  FetchedState state;
  MapHead& head = state.head;
  head = {.row = MapRowOf(snapshot), .commit_id = 1, .owner = owner, .owner_epoch = map.epoch};
  head.row.key = map.key;
  head.row.seal.version = MapSealVersion();
  state.tiles = TileWrites(head.next_blob_key);
  calls.push_back({&kBegin});
  calls.emplace_back(Call{&kNameMap}).values.Add(snapshot.info().name).Add(map.key);
  const StateMarks nothing;
  const CommitRequest request{nothing, snapshot};
  const std::vector<SubmapTileChange> changes = DiffTiles(nothing, snapshot);
  MapHead after = head;
  DHPMAP_ASSIGN_OR_RETURN(statements.written,
                          Planner(request, changes, map, limits, pool, state).Plan(MapParts(), after, calls));
  calls.push_back(InsertHead(after));
  calls.push_back({&kCommit});
  return statements;
}

}  // namespace dhpmap::postgres
