// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/commit.h"

#include <iterator>
#include <string>
#include <utility>

#include "storage/postgres/commit/commit_plan.h"
#include "storage/postgres/transaction_text.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

const std::string kNameMap = "INSERT INTO map_names (name, map_key) VALUES ($1, $2)";
const std::string kPutPlaces = "INSERT INTO commit_places (map_key, commit_id, places) VALUES ($1, $2, $3)";
const std::string kTrimPlaces = "DELETE FROM commit_places WHERE map_key = $1 AND commit_id <= $2";

/// For followers of the map. Only every 61st commit deletes old places: a prime, so that a regular pattern of commits
/// without places cannot skip it for ever.
void WritePlaces(const MapHead& head, const FetchedState& state, std::vector<Call>& calls) {
  constexpr std::int64_t kCommitsATrim = 61;
  CommitPlaces places;
  state.tiles.AddTo(places);
  state.submaps.AddTo(places);
  calls.emplace_back(Call{&kPutPlaces}).values.Add(head.row.key).Add(head.commit_id).Add(ByteView(places.Encode()));
  if (head.commit_id % kCommitsATrim != 0) return;
  calls.emplace_back(Call{&kTrimPlaces}).values.Add(head.row.key).Add(head.commit_id - CommitPlaces::kNumKept);
}

}  // namespace

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
  DHPMAP_ASSIGN_OR_RETURN(statements.written, CommitPlan(request, changes, map, limits, pool, state)
                                                  .Make(MapPartsOf(map.key, request.before.info()), head, body));
  WritePlaces(head, state, body);
  statements.calls.reserve(body.size() + 3);
  statements.calls.push_back({&BeginText()});
  statements.calls.push_back(ReplaceHead(state.head, head));
  std::move(body.begin(), body.end(), std::back_inserter(statements.calls));
  statements.calls.push_back({&CommitText()});
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
  calls.push_back({&BeginText()});
  calls.emplace_back(Call{&kNameMap}).values.Add(snapshot.info().name).Add(map.key);
  const StateMarks nothing;
  const CommitRequest request{nothing, snapshot};
  const std::vector<SubmapTileChange> changes = DiffTiles(nothing, snapshot);
  MapHead after = head;
  DHPMAP_ASSIGN_OR_RETURN(statements.written,
                          CommitPlan(request, changes, map, limits, pool, state).Make(MapParts(), after, calls));
  calls.push_back(InsertHead(after));
  calls.push_back({&CommitText()});
  return statements;
}

}  // namespace dhpmap::postgres
