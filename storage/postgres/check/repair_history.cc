// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/check/repair_history.h"

#include <span>
#include <string>

#include "storage/codec/edit_codec.h"
#include "storage/postgres/check/history_to_verify.h"

namespace dhpmap::postgres {
namespace {

const std::string kDropEdits = "DELETE FROM edits WHERE map_key = $1 AND revision = ANY ($2)";
const std::string kDropUndos = "DELETE FROM edit_histories WHERE map_key = $1 AND edit_key = ANY ($2)";
const std::string kDropAllUndos = "DELETE FROM edit_histories WHERE map_key = $1";
const std::string kDropStrayUndos =
    "DELETE FROM edit_histories WHERE map_key = $1 AND edit_key NOT IN (SELECT e.revision FROM edits e WHERE e.map_key "
    "= "
    "$1)";
const std::string kDropStrayEditTiles =
    "DELETE FROM edit_tiles WHERE map_key = $1 AND edit_key NOT IN (SELECT h.edit_key FROM edit_histories h WHERE "
    "h.map_key = $1)";
const std::string kDropStrayTargets =
    "DELETE FROM edit_targets WHERE map_key = $1 AND target NOT IN (SELECT e.revision FROM edits e WHERE e.map_key = "
    "$1)";
const std::string kForgetTotals = "DELETE FROM edit_totals WHERE map_key = $1";
const std::string kNoteTotals =
    "INSERT INTO edit_totals (map_key, num_edits, edit_bytes, num_histories, history_bytes) SELECT $1, e.n, e.bytes, "
    "h.n, h.bytes FROM (SELECT count(*) AS n, coalesce(sum(64 + octet_length(author) + octet_length(request_id) + "
    "octet_length(summary) + octet_length(answer)), 0) AS bytes FROM edits WHERE map_key = $1) e, (SELECT count(*) AS "
    "n, "
    "coalesce(sum(num_bytes), 0) AS bytes FROM edit_histories WHERE map_key = $1) h";
const std::string kForgetAllChanges = "DELETE FROM changes WHERE map_key = $1";
const std::string kForgetChangeLog = "DELETE FROM change_logs WHERE map_key = $1";
const std::string kNoteTarget =
    "INSERT INTO edit_targets (map_key, target, revision, kind) SELECT $1, e.revision, $3, $4 FROM edits e WHERE "
    "e.map_key = $1 AND e.revision = $2 ON CONFLICT (map_key, target, revision) DO UPDATE SET kind = excluded.kind";

}  // namespace

std::vector<Call> CallsForHistory(std::int64_t map_key, const BadHistory& bad, bool is_state_changed) {
  std::vector<Call> calls;
  const auto add = [&](const std::string& text) -> Values& {
    return calls.emplace_back(Call{&text}).values.Add(map_key);
  };
  add(kDropEdits).Add(std::span<const std::int64_t>(bad.edits));
  add(kDropUndos).Add(std::span<const std::int64_t>(bad.undos));
  if (is_state_changed) add(kDropAllUndos);
  for (const std::string* text : {&kDropStrayUndos, &kDropStrayEditTiles, &kDropStrayTargets, &kForgetTotals,
                                  &kNoteTotals, &kForgetAllChanges, &kForgetChangeLog}) {
    add(*text);
  }
  return calls;
}

Status NoteTargets(Connection& connection, std::int64_t map_key) {
  std::vector<Call> calls;
  const Status read = HistoryToVerify(connection, map_key).ForEachEdit([&](const EditRow& row, bool is_read) {
    EditEntry entry;
    entry.revision = row.revision;
    if (!is_read || !DecodeEditSummary(row.summary.bytes, entry).ok()) return Status::Ok();
    for (const std::int64_t target : entry.summary.targets) {
      Values& values = calls.emplace_back(Call{&kNoteTarget}).values;
      values.Add(map_key).Add(target).Add(row.revision).Add(static_cast<std::int64_t>(row.kind));
    }
    return Status::Ok();
  });
  DHPMAP_RETURN_IF_ERROR(read);
  return calls.empty() ? Status::Ok() : connection.Run(calls, "repair what was changed").status;
}

}  // namespace dhpmap::postgres
