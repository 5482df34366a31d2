// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/following/later_state.h"

#include <span>
#include <utility>
#include <vector>

#include "storage/commit/store_number.h"
#include "storage/postgres/following/state_patch.h"
#include "storage/postgres/reading/map_reader.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/rows/part_rows.h"
#include "storage/postgres/tiles/commit_places.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadLaterTask[] = "read what was committed";
const std::string kPlaces =
    "SELECT places FROM commit_places WHERE map_key = $1 AND commit_id > $2 ORDER BY commit_id LIMIT $3";
/// Beyond it the whole map is read, which takes less memory at once.
constexpr std::size_t kMostTileRows = 16'384;

}  // namespace

Result<StateToRead> ReadState(Connection& connection, const std::string& name, ThreadPool& pool) {
  Call call{&HeadByName()};
  call.values.Add(name);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadLaterTask));
  MapHead head;
  if (!answer.Next()) return NoSuchMap(name);
  if (!ReadHead(answer, head)) return DamagedRows(name, "its row has a wrong checksum");
  // The state may be later than this commit; rows in between are then read once more.
  StateToRead state{.map_key = head.row.key, .commit_id = head.commit_id, .store = NextStoreNumber()};
  DHPMAP_ASSIGN_OR_RETURN(state.snapshot, ReadMapState(connection, name, state.map_key, state.store, pool));
  return state;
}

Result<std::optional<StateToRead>> ReadLaterState(Connection& connection, const StateToRead& before, ThreadPool& pool) {
  const std::string& name = before.snapshot->info().name;
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  std::vector<Call> calls = CallsForParts(before.map_key);
  calls.emplace_back(Call{&HeadByName()}).values.Add(name);
  calls.emplace_back(Call{&kPlaces}).values.Add(before.map_key).Add(before.commit_id).Add(CommitPlaces::kNumKept);
  Answers got = connection.Run(calls, kReadLaterTask);
  if (!got.status.ok()) return got.status;
  MapHead head;
  if (!got.answers[6].Next()) return NoSuchMap(name);
  if (!ReadHead(got.answers[6], head)) return DamagedRows(name, "its row has a wrong checksum");
  if (head.row.key != before.map_key || head.commit_id - before.commit_id > CommitPlaces::kNumKept) {
    return std::optional<StateToRead>();
  }
  if (head.commit_id == before.commit_id && head.row.info.revision == before.snapshot->revision()) {
    return std::optional(before);
  }
  CommitPlaces places;
  while (got.answers[7].Next()) DHPMAP_RETURN_IF_ERROR(places.Add(got.answers[7].Blob()));
  if (places.NumTileRows() > kMostTileRows) return std::optional<StateToRead>();
  DHPMAP_ASSIGN_OR_RETURN(const MapParts parts, ReadParts(std::span(got.answers).first(6)));
  DHPMAP_RETURN_IF_ERROR(FillInfo(head.row, parts));
  StatePatch later(before, head.row, places, pool);
  DHPMAP_RETURN_IF_ERROR(later.Read(connection));
  StateToRead state{.map_key = before.map_key, .commit_id = head.commit_id, .store = before.store};
  DHPMAP_ASSIGN_OR_RETURN(state.snapshot, later.Make());
  return std::optional(std::move(state));
}

}  // namespace dhpmap::postgres
