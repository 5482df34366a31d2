// SPDX-License-Identifier: BSD-3-Clause
// EditWrites: deletes the oldest rows of the log and the undo data.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "storage/history/logged_edit.h"
#include "storage/postgres/history/edit_writes.h"

namespace dhpmap::postgres {
namespace {

/// An edit deletes at most this many rows beyond the limits.
constexpr std::size_t kMostTrimmed = 16;

const std::string kPutTotals =
    "INSERT INTO edit_totals (map_key, num_edits, edit_bytes, num_histories, history_bytes) VALUES ($1, $2, $3, $4, "
    "$5) "
    "ON CONFLICT (map_key) DO UPDATE SET num_edits = excluded.num_edits, edit_bytes = excluded.edit_bytes, "
    "num_histories = excluded.num_histories, history_bytes = excluded.history_bytes";
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

}  // namespace

/// The newest row stays whatever its size: the client may repeat its request.
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
