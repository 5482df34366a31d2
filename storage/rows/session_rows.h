// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/session_marks.h"
#include "storage/rows/table.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// How far one session of frames has got in a map.
struct SessionRow {
  std::int64_t map_key = 0;
  SessionMark mark;
};

/// The columns of table feed_sessions. `Row` is a SessionRow, or derived from it.
template <typename Row = SessionRow>
std::vector<Column<Row>> SessionColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kOnce, 0, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("session", kOnce, 3, DHPMAP_MEMBER(mark.session)),
      MakeColumn<Row>("sequence", kAlways, 3, DHPMAP_MEMBER(mark.sequence)),
      MakeColumn<Row>("time_ns", kAlways, 3, DHPMAP_MEMBER(mark.time_ns)),
  };
}
const Table<SessionRow>& Sessions();

/// By ascending name.
Result<std::vector<SessionRow>> ReadSessionRows(sqlite::Database& database, std::int64_t map_key);
/// Brings the rows from what `before` says to what `after` says, writing those that differ. Returns them all, by
/// ascending name.
Result<std::vector<SessionRow>> WriteSessionRows(sqlite::Database& database, std::int64_t map_key,
                                                 const SessionMarks& before, const SessionMarks& after);

/// `version`: of the checksum in the map's row, which stands for its sessions, too; 3 or later.
std::uint32_t SessionsChecksum(const std::vector<SessionRow>& rows, int version);

/// DATA_LOSS if they are no marks of sessions.
Result<SessionMarks> SessionMarksOf(const std::vector<SessionRow>& rows);

}  // namespace dhpmap
