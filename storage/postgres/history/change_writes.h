// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mapping/changes/map_change.h"
#include "mapping/map/map.h"
#include "storage/postgres/answer.h"
#include "storage/postgres/values.h"
#include "storage/rows/change_rows.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// The change log of a map during a commit: rows fetched and rows to write.
class ChangeWrites {
 public:
  // Answers to the two statements below.
  void FetchedLog(Answer& log);
  void FetchedOldest(Answer& oldest);

  /// Adds the statements that write the change of a commit and trim the log, as RecordChange does. `info`: of the later
  /// state.
  void Write(std::int64_t map_key, const MapInfo& info, const MapChange& change, std::int64_t now_ns,
             const ChangeHistoryLimits& limits, std::vector<Call>& calls);

 private:
  struct Old {
    std::int64_t revision = 0, seen_ns = 0, num_bytes = 0;
  };
  [[nodiscard]] ChangeLogRow LogBefore(std::int64_t map_key, const MapInfo& info, const MapChange& change,
                                       std::vector<Call>& calls);
  void Trim(const ChangeHistoryLimits& limits, std::int64_t now_ns, ChangeLogRow& log, std::vector<Call>& calls) const;

  std::optional<ChangeLogRow> log_;  ///< nothing if there is none, or it is damaged
  std::vector<Old> oldest_;
};

/// SELECTs by map_key ($1).
const std::string& LogOfChanges();
const std::string& OldestChanges();

}  // namespace dhpmap::postgres
