// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/edit_writes.h"

#include <algorithm>
#include <span>

#include "storage/history/logged_edit.h"
#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

/// Of those beyond the limits so many go with one edit.
constexpr std::size_t kMostTrimmed = 16;

const std::string kTotals =
    "SELECT num_edits, edit_bytes, num_histories, history_bytes FROM edit_totals WHERE map_key = $1";
const std::string kOldestEdits =
    "SELECT revision, seen_ns, 64 + octet_length(author) + octet_length(request_id) + octet_length(summary) + "
    "octet_length(answer) FROM edits WHERE map_key = $1 ORDER BY revision LIMIT 16";
// More than are trimmed, as edits that leave the log take theirs along.
const std::string kOldestHistories =
    "SELECT h.edit_key, e.seen_ns, h.num_bytes, (SELECT count(*) FROM edit_tiles t WHERE t.map_key = h.map_key AND "
    "t.edit_key = h.edit_key) FROM edit_histories h JOIN edits e ON e.map_key = h.map_key AND e.revision = h.edit_key "
    "WHERE h.map_key = $1 ORDER BY h.edit_key LIMIT 33";
const std::string kPutTotals =
    "INSERT INTO edit_totals (map_key, num_edits, edit_bytes, num_histories, history_bytes) VALUES ($1, $2, $3, $4, "
    "$5) "
    "ON CONFLICT (map_key) DO UPDATE SET num_edits = excluded.num_edits, edit_bytes = excluded.edit_bytes, "
    "num_histories = excluded.num_histories, history_bytes = excluded.history_bytes";
const std::string kPutTarget =
    "INSERT INTO edit_targets (map_key, target, revision, kind) VALUES ($1, $2, $3, $4) ON CONFLICT (map_key, target, "
    "revision) DO UPDATE SET kind = excluded.kind";
const std::string kTrimEdits = "DELETE FROM edits WHERE map_key = $1 AND revision = ANY ($2)";
const std::string kTrimTargets = "DELETE FROM edit_targets WHERE map_key = $1 AND target = ANY ($2)";
const std::string kTrimHistories = "DELETE FROM edit_histories WHERE map_key = $1 AND edit_key = ANY ($2)";
const std::string kTrimEditTiles =
    "WITH gone AS (DELETE FROM edit_tiles WHERE map_key = $1 AND edit_key = ANY ($2) RETURNING before_key, after_key), "
    "let_go AS (SELECT before_key AS blob_key FROM gone WHERE before_key <> 0 UNION ALL SELECT after_key FROM gone "
    "WHERE "
    "after_key <> 0) INSERT INTO blob_counts AS c (map_key, blob_key, num_refs, since_ns) SELECT $1, blob_key, 1 - "
    "count(*), $3 FROM let_go GROUP BY blob_key ON CONFLICT (map_key, blob_key) DO UPDATE SET num_refs = c.num_refs + "
    "excluded.num_refs - 1, since_ns = excluded.since_ns";
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

/// The newest stays, whatever it takes: it was made, and may be asked for again.
void EditWrites::TrimLog(std::int64_t map_key, std::int64_t newest, std::int64_t now_ns, const EditLogLimits& limits,
                         std::vector<Call>& calls) {
  std::vector<std::int64_t> gone;
  for (const OldEdit& old : edits_) {
    if (old.revision == newest || !IsBeyond(limits, num_edits_, edit_bytes_, old.seen_ns, now_ns)) break;
    gone.push_back(old.revision);
    --num_edits_;
    edit_bytes_ -= old.num_bytes;
  }
  if (gone.empty()) return;
  const std::span<const std::int64_t> keys(gone);
  calls.emplace_back(Call{&kTrimEdits}).values.Add(map_key).Add(keys);
  calls.emplace_back(Call{&kTrimTargets}).values.Add(map_key).Add(keys);
  std::erase_if(histories_, [&](const OldHistory& history) {
    if (std::find(gone.begin(), gone.end(), history.edit_key) == gone.end()) return false;
    Forget(history, forgotten_);
    return true;
  });
}

void EditWrites::Forget(const OldHistory& history, std::vector<std::int64_t>& forgotten) {
  --num_histories_;
  history_bytes_ -= history.num_bytes;
  forgotten.push_back(history.edit_key);
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
  if (!EditHistories().IsIntact(history, history.seal)) return;  // stays what it is: not to be read
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

bool EditWrites::IsBeyondHistories(const OldHistory& oldest, std::int64_t now_ns, const EditLogLimits& limits) const {
  return num_histories_ > limits.max_histories || history_bytes_ > limits.max_history_bytes ||
         static_cast<double>(now_ns - oldest.seen_ns) > limits.max_history_age_s * 1e9;
}

void EditWrites::Finish(std::int64_t map_key, std::int64_t now_ns, const EditLogLimits& limits,
                        std::vector<Call>& calls) {
  std::vector<std::int64_t> forgotten = forgotten_;
  if (!histories_.empty() && histories_.back().num_bytes > limits.max_history_bytes) {  // the newest alone is too much
    Forget(histories_.back(), forgotten);
    histories_.pop_back();
  }
  std::int64_t num_tiles = 0;
  for (std::size_t n = 0; n < std::min(kMostTrimmed, histories_.size()) && num_tiles < kMostTilesTrimmed; ++n) {
    if (!IsBeyondHistories(histories_[n], now_ns, limits)) break;
    num_tiles += histories_[n].num_tiles;
    if (n > 0 && num_tiles > kMostTilesTrimmed) break;
    Forget(histories_[n], forgotten);
  }
  if (!forgotten.empty()) {
    const std::span<const std::int64_t> keys(forgotten);
    calls.emplace_back(Call{&kTrimHistories}).values.Add(map_key).Add(keys);
    calls.emplace_back(Call{&kTrimEditTiles}).values.Add(map_key).Add(keys).Add(now_ns);
  }
  Values& totals = calls.emplace_back(Call{&kPutTotals}).values;
  totals.Add(map_key).Add(num_edits_).Add(edit_bytes_).Add(num_histories_).Add(history_bytes_);
}

}  // namespace dhpmap::postgres
