// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/postgres/answer.h"
#include "storage/postgres/history/edit_tile_writes.h"
#include "storage/postgres/values.h"
#include "storage/rows/edit_rows.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// The edit log of a map and its undo data during a commit: what was fetched of them, and what is to be written.
class EditWrites {
 public:
  // Answers to the statements below.
  void FetchedTotals(Answer& totals);
  void FetchedOldEdits(Answer& edits);
  void FetchedOldHistories(Answer& histories);

  /// Adds the edit to the log and trims it.
  void Record(std::int64_t map_key, const EditRecord& edit, std::int64_t now_ns, const EditLogLimits& limits,
              std::vector<Call>& calls);
  /// Adds its undo data.
  void Keep(const EditHistoryRow& history, std::int64_t now_ns, const EditTileWrites& tiles, std::vector<Call>& calls);
  /// Adds to undo data that are there; `history` is their row.
  void GoOn(EditHistoryRow history, std::int64_t now_ns, const EditTileWrites& tiles, std::vector<Call>& calls);
  /// Trims undo data, and writes the totals. Last.
  void Finish(std::int64_t map_key, std::int64_t now_ns, const EditLogLimits& limits, std::vector<Call>& calls);

 private:
  struct OldEdit {
    std::int64_t revision = 0, seen_ns = 0, num_bytes = 0;
  };
  struct OldHistory {
    std::int64_t edit_key = 0, seen_ns = 0, num_bytes = 0, num_tiles = 0;
  };
  void TrimLog(std::int64_t map_key, std::int64_t newest, std::int64_t now_ns, const EditLogLimits& limits,
               std::vector<Call>& calls);
  void Forget(const OldHistory& history, std::vector<std::int64_t>& forgotten);
  [[nodiscard]] bool IsBeyondHistories(const OldHistory& oldest, std::int64_t now_ns,
                                       const EditLogLimits& limits) const;

  std::int64_t num_edits_ = 0, edit_bytes_ = 0, num_histories_ = 0, history_bytes_ = 0;
  std::vector<OldEdit> edits_;
  std::vector<OldHistory> histories_;    ///< the oldest, and what this commit adds
  std::vector<std::int64_t> forgotten_;  ///< histories of edits that leave the log
};

// SELECTs by map_key ($1).
const std::string& TotalsOfEdits();
const std::string& OldestEdits();
const std::string& OldestHistories();
/// The undo data of the newest edit, if they are kept.
const std::string& NewestHistory();

}  // namespace dhpmap::postgres
