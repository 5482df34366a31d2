// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/session_marks.h"
#include "storage/rows/table.h"

namespace dhpmap {

namespace sqlite {
class Database;
}

/// Progress of a feed session in a map.
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
/// Updates the rows from `before` to `after`, writing only differences. Returns all rows, by ascending name.
Result<std::vector<SessionRow>> WriteSessionRows(sqlite::Database& database, std::int64_t map_key,
                                                 const SessionMarks& before, const SessionMarks& after);

/// `version`: of the map row's checksum, which covers its sessions; 3 or later.
std::uint32_t SessionsChecksum(const std::vector<SessionRow>& rows, int version);

/// DATA_LOSS unless they are valid marks.
Result<SessionMarks> SessionMarksOf(const std::vector<SessionRow>& rows);

}  // namespace dhpmap
