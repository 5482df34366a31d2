// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/edit_writes.h"

#include <algorithm>

#include "storage/history/logged_edit.h"
#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

const std::string kTotals =
    "SELECT num_edits, edit_bytes, num_histories, history_bytes FROM edit_totals WHERE map_key = $1";
const std::string kOldestEdits =
    "SELECT revision, seen_ns, 64 + octet_length(author) + octet_length(request_id) + octet_length(summary) + "
    "octet_length(answer) FROM edits WHERE map_key = $1 ORDER BY revision LIMIT 16";
// More than are trimmed, since edits that leave the log take their histories along.
const std::string kOldestHistories =
    "SELECT h.edit_key, e.seen_ns, h.num_bytes, (SELECT count(*) FROM edit_tiles t WHERE t.map_key = h.map_key AND "
    "t.edit_key = h.edit_key) FROM edit_histories h JOIN edits e ON e.map_key = h.map_key AND e.revision = h.edit_key "
    "WHERE h.map_key = $1 ORDER BY h.edit_key LIMIT 33";
const std::string kPutTarget =
    "INSERT INTO edit_targets (map_key, target, revision, kind) VALUES ($1, $2, $3, $4) ON CONFLICT (map_key, target, "
    "revision) DO UPDATE SET kind = excluded.kind";
const std::string kGoOnHistory =
    "UPDATE edit_histories SET num_bytes = $3, tiles_sum = $4, checksum_version = $5, checksum = $6 WHERE map_key = $1 "
    "AND edit_key = $2";

}  // namespace

const std::string& TotalsOfEdits() { return kTotals; }
const std::string& OldestEdits() { return kOldestEdits; }
const std::string& OldestHistories() { return kOldestHistories; }

const std::string& NewestHistory() {
  static const std::string text = SelectText(
      EditHistories(), "WHERE map_key = $1 AND edit_key = (SELECT max(e.revision) FROM edits e WHERE e.map_key = $1)");
  return text;
}

void EditWrites::FetchedTotals(Answer& totals) {
  if (!totals.Next()) return;
  for (std::int64_t* number : {&num_edits_, &edit_bytes_, &num_histories_, &history_bytes_}) *number = totals.Int();
}

void EditWrites::FetchedOldEdits(Answer& edits) {
  while (edits.Next()) {
    OldEdit& edit = edits_.emplace_back();
    for (std::int64_t* number : {&edit.revision, &edit.seen_ns, &edit.num_bytes}) *number = edits.Int();
  }
}

void EditWrites::FetchedOldHistories(Answer& histories) {
  while (histories.Next()) {
    OldHistory& old = histories_.emplace_back();
    for (std::int64_t* number : {&old.edit_key, &old.seen_ns, &old.num_bytes, &old.num_tiles}) {
      *number = histories.Int();
    }
  }
}

void EditWrites::Record(std::int64_t map_key, const EditRecord& edit, std::int64_t now_ns, const EditLogLimits& limits,
                        std::vector<Call>& calls) {
  static const std::string insert = InsertText(Edits());
  const EditRow row = EditRowOf(map_key, edit, now_ns);
  Edits().BindAll(row, calls.emplace_back(Call{&insert}).values);
  ++num_edits_;
  edit_bytes_ += LogBytesOf(edit, row.summary.bytes.size());
  for (const std::int64_t target : edit.entry.summary.targets) {
    Values& values = calls.emplace_back(Call{&kPutTarget}).values;
    values.Add(map_key).Add(target).Add(row.revision).Add(static_cast<std::int64_t>(row.kind));
  }
  TrimLog(map_key, row.revision, now_ns, limits, calls);
}

void EditWrites::Keep(const EditHistoryRow& history, std::int64_t now_ns, const EditTileWrites& tiles,
                      std::vector<Call>& calls) {
  static const std::string insert = InsertText(EditHistories());
  EditHistories().BindAll(history, calls.emplace_back(Call{&insert}).values);
  tiles.Write(history.map_key, calls);
  ++num_histories_;
  history_bytes_ += history.num_bytes;
  histories_.push_back({history.key, now_ns, history.num_bytes, 0});
}

void EditWrites::GoOn(EditHistoryRow history, std::int64_t now_ns, const EditTileWrites& tiles,
                      std::vector<Call>& calls) {
  if (!EditHistories().IsIntact(history, history.seal)) return;  // stays unreadable
  const EditTileSums more = tiles.sums();
  history.num_bytes += more.num_bytes;
  history.tiles_sum =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(history.tiles_sum) + static_cast<std::uint64_t>(more.sum));
  history.seal = EditHistories().SealOf(history);
  Values& values = calls.emplace_back(Call{&kGoOnHistory}).values;
  values.Add(history.map_key).Add(history.key).Add(history.num_bytes).Add(history.tiles_sum);
  values.Add(history.seal.version).Add(history.seal.checksum);
  tiles.Write(history.map_key, calls);
  history_bytes_ += more.num_bytes;
  const auto known = std::find_if(histories_.begin(), histories_.end(),
                                  [&](const OldHistory& old) { return old.edit_key == history.key; });
  if (known != histories_.end()) known->num_bytes = history.num_bytes;
  else histories_.push_back({history.key, now_ns, history.num_bytes, 0});  // the newest
}

}  // namespace dhpmap::postgres
