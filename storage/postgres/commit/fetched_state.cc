// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/fetched_state.h"

#include <span>
#include <string>

#include "storage/postgres/rows/selects.h"
#include "storage/postgres/rows/table_text.h"
#include "storage/postgres/tiles/tile_owner.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

constexpr char kFetchTask[] = "read what a commit changes";

using Keys = std::vector<std::int64_t>;

/// The keys to fetch.
struct WantedTiles {
  Keys submap_ids, whole_owners, blobs;
  Keys owners, x, y, z;  ///< of single tiles

  void AddTile(std::int64_t owner, TileIndex index) {
    owners.push_back(owner);
    x.push_back(index.x);
    y.push_back(index.y);
    z.push_back(index.z);
  }
};

void AddSubmap(const SubmapTileChange& change, std::uint16_t store, WantedTiles& wanted) {
  const std::int64_t id = change.id.value;
  wanted.submap_ids.push_back(id);
  if (change.copy_of) {
    wanted.submap_ids.push_back(change.copy_of->value);
    wanted.whole_owners.push_back(change.copy_of->value);
  } else if (change.after == nullptr) {
    wanted.whole_owners.push_back(id);
  }
  for (const TileChange& tile : change.tiles) {
    if (!change.is_new) wanted.AddTile(id, tile.index);
    for (std::size_t i = 0; tile.after != nullptr && i < kNumBlockLayers; ++i) {
      const std::int64_t key = tile.after->stored(static_cast<BlockLayer>(i)).In(store);
      if (tile.is_written[i] && tile.num_after[i] > 0 && key != 0) wanted.blobs.push_back(key);
    }
  }
}

WantedTiles WantedBy(const PlannedChanges& changes) {
  WantedTiles wanted;
  for (const SubmapTileChange& change : changes.submaps) AddSubmap(change, changes.store, wanted);
  for (const FreeSpaceChange* layer : {&changes.free_space, &changes.vacated}) {
    for (const TileIndex index : layer->erased) wanted.AddTile(kMapsOwner, index);
    for (const FreeTileEntry* entry : layer->written) wanted.AddTile(kMapsOwner, entry->index);
  }
  return wanted;
}

std::span<const std::int64_t> View(const Keys& keys) { return keys; }

std::vector<Call> CallsFor(std::int64_t map_key, const WantedTiles& wanted, const PlannedChanges& changes) {
  std::vector<Call> calls;
  const auto add = [&](const std::string& sql) -> Values& {
    return calls.emplace_back(Call{&sql}).values.Add(map_key);
  };
  add(HeadByKey());
  add(SubmapsById()).Add(View(wanted.submap_ids));
  add(TilesByPlace()).Add(View(wanted.owners)).Add(View(wanted.x)).Add(View(wanted.y)).Add(View(wanted.z));
  add(TilesByOwner()).Add(View(wanted.whole_owners));
  add(BlobsByKey()).Add(View(wanted.blobs));
  add(LogOfChanges());
  add(OldestChanges());
  if (!changes.is_edit && !changes.goes_on_with_edit) return calls;
  add(TotalsOfEdits());
  add(OldestEdits());
  add(OldestHistories());
  if (changes.goes_on_with_edit) add(NewestHistory());
  return calls;
}

Status FetchLeft(Connection& connection, Answer& history, FetchedState& state) {
  EditHistoryRow row;
  if (!state.head.row.leaving() || !history.Next()) return Status::Ok();
  if (!ReadRow(EditHistories(), history, row)) return Status::Ok();
  Call call{&OwnTilesOfEdit()};
  call.values.Add(state.head.row.key).Add(row.key);
  DHPMAP_ASSIGN_OR_RETURN(Answer tiles, connection.Query(call, kFetchTask));
  state.left.emplace(row.key, state.tiles);
  state.left->Fetched(tiles);
  state.last_history = std::move(row);
  return Status::Ok();
}

}  // namespace

Status Fetch(Connection& connection, const std::string& name, std::int64_t map_key, const PlannedChanges& changes,
             FetchedState& state) {
  const std::vector<Call> calls = CallsFor(map_key, WantedBy(changes), changes);
  Answers got = connection.Run(calls, kFetchTask);
  if (!got.status.ok()) return got.status;
  std::vector<Answer>& answers = got.answers;
  if (!answers[0].Next()) return NoSuchMap(name);
  if (!ReadHead(answers[0], state.head)) return DamagedRows(name, "its row has a wrong checksum");
  state.tiles = TileWrites(state.head.next_blob_key);
  state.submaps.Fetched(answers[1]);
  state.tiles.Fetched(answers[2]);
  state.tiles.Fetched(answers[3]);
  state.tiles.FetchedBlobs(answers[4]);
  state.changes.FetchedLog(answers[5]);
  state.changes.FetchedOldest(answers[6]);
  if (calls.size() > 7) {
    state.edits.FetchedTotals(answers[7]);
    state.edits.FetchedOldEdits(answers[8]);
    state.edits.FetchedOldHistories(answers[9]);
  }
  return changes.goes_on_with_edit ? FetchLeft(connection, answers[10], state) : Status::Ok();
}

}  // namespace dhpmap::postgres
