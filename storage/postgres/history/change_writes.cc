// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/change_writes.h"

#include <utility>

#include "storage/codec/change_codec.h"
#include "storage/history/logged_change.h"
#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

/// A commit adds one row and deletes at most this many beyond the limits: the LIMIT below.
constexpr std::size_t kMostTrimmedChanges = 16;
const std::string kOldestChanges =
    "SELECT last_revision, seen_ns, octet_length(blob) FROM changes WHERE map_key = $1 ORDER BY last_revision LIMIT 16";
const std::string kForgetChanges = "DELETE FROM changes WHERE map_key = $1";
const std::string kTrimChanges = "DELETE FROM changes WHERE map_key = $1 AND last_revision <= $2";

}  // namespace

const std::string& LogOfChanges() {
  static const std::string text = SelectText(ChangeLogs(), "WHERE map_key = $1");
  return text;
}

const std::string& OldestChanges() { return kOldestChanges; }

void ChangeWrites::FetchedLog(Answer& log) {
  ChangeLogRow row;
  if (!log.Next()) return;
  if (ReadRow(ChangeLogs(), log, row) && ChangeLogs().IsIntact(row, row.seal)) log_ = row;
}

void ChangeWrites::FetchedOldest(Answer& oldest) {
  while (oldest.Next()) {
    Old& old = oldest_.emplace_back();
    old.revision = oldest.Int();
    old.seen_ns = oldest.Int();
    old.num_bytes = oldest.Int();
  }
}

/// The log that the change continues.
ChangeLogRow ChangeWrites::LogBefore(std::int64_t map_key, const MapInfo& info, const MapChange& change,
                                     std::vector<Call>& calls) {
  const std::int64_t before = change.first_revision - 1;
  if (log_ && log_->history_id == info.history_id && log_->last_revision <= before) return *log_;
  calls.emplace_back(Call{&kForgetChanges}).values.Add(map_key);
  oldest_.clear();
  return {
      .map_key = map_key, .history_id = info.history_id, .complete_after = before, .last_revision = before, .seal = {}};
}

void ChangeWrites::Trim(const ChangeHistoryLimits& limits, std::int64_t now_ns, ChangeLogRow& log,
                        std::vector<Call>& calls) const {
  std::optional<std::int64_t> last;
  for (const Old& old : oldest_) {
    const bool is_left_out = old.revision <= log.complete_after;
    if (!is_left_out && !IsBeyond(limits, {log.num_changes, log.num_bytes}, old.seen_ns, now_ns)) break;
    if (!is_left_out) log.complete_after = old.revision;
    --log.num_changes;
    log.num_bytes -= old.num_bytes;
    last = old.revision;
  }
  if (last) calls.emplace_back(Call{&kTrimChanges}).values.Add(log.map_key).Add(*last);
}

void ChangeWrites::Write(std::int64_t map_key, const MapInfo& info, const MapChange& change, std::int64_t now_ns,
                         const ChangeHistoryLimits& limits, std::vector<Call>& calls) {
  static const std::string upsert = UpsertText(Changes()), upsert_log = UpsertText(ChangeLogs());
  ChangeLogRow log = LogBefore(map_key, info, change, calls);
  Bytes blob = EncodeChange(change);
  const auto num_bytes = static_cast<std::int64_t>(blob.size());
  if (num_bytes > limits.max_bytes) {
    log.complete_after = change.last_revision;  // it does not fit, so the earlier changes are useless too
  } else {
    const ChangeRow row = ChangeRowOf(change, std::move(blob), now_ns, log);
    Changes().BindAll(row, calls.emplace_back(Call{&upsert}).values);
    ++log.num_changes;
    log.num_bytes += num_bytes;
    // If all rows were fetched, it is the next.
    if (oldest_.size() < kMostTrimmedChanges) oldest_.push_back({row.last_revision, now_ns, num_bytes});
  }
  log.last_revision = change.last_revision;
  Trim(limits, now_ns, log, calls);
  log.seal = ChangeLogs().SealOf(log);
  ChangeLogs().BindAll(log, calls.emplace_back(Call{&upsert_log}).values);
}

}  // namespace dhpmap::postgres
