// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/session_rows.h"

#include <algorithm>
#include <utility>

#include "storage/sqlite/database.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadSessionsTask[] = "read a map's sessions";
constexpr char kWriteSessionsTask[] = "write a map's sessions";

Status EraseGone(Database& database, std::int64_t map_key, const SessionMarks& before, const SessionMarks& after) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement erase,
      database.Prepare("DELETE FROM feed_sessions WHERE map_key = ? AND session = ?", kWriteSessionsTask));
  for (const SessionMark& mark : before.marks()) {
    if (!after.LastOf(mark.session)) DHPMAP_RETURN_IF_ERROR(erase.Bind(map_key).Bind(mark.session).Run());
  }
  return Status::Ok();
}

}  // namespace

const Table<SessionRow>& Sessions() {
  static const Table<SessionRow> table("feed_sessions", SessionColumns());
  return table;
}

Result<std::vector<SessionRow>> ReadSessionRows(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(Sessions().Select("WHERE map_key = ? ORDER BY session"), kReadSessionsTask));
  select.Bind(map_key);
  std::vector<SessionRow> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return rows;
    if (!Sessions().Read(select, rows.emplace_back())) return DataLoss("its sessions are damaged");
  }
}

Result<std::vector<SessionRow>> WriteSessionRows(Database& database, std::int64_t map_key, const SessionMarks& before,
                                                 const SessionMarks& after) {
  DHPMAP_RETURN_IF_ERROR(EraseGone(database, map_key, before, after));
  DHPMAP_ASSIGN_OR_RETURN(Statement upsert, database.Prepare(Sessions().Upsert(), kWriteSessionsTask));
  std::vector<SessionRow> rows;
  for (const SessionMark& mark : after.marks()) {
    const SessionRow& row = rows.emplace_back(SessionRow{map_key, mark});
    const auto& known = before.marks();
    if (std::find(known.begin(), known.end(), mark) != known.end()) continue;
    Sessions().BindAll(row, upsert);
    DHPMAP_RETURN_IF_ERROR(upsert.Run());
  }
  return rows;
}

std::uint32_t SessionsChecksum(const std::vector<SessionRow>& rows, int version) {
  Bytes bytes;
  for (const SessionRow& row : rows) Sessions().Cover(row, version, bytes);
  return Crc32c(bytes);
}

Result<SessionMarks> SessionMarksOf(const std::vector<SessionRow>& rows) {
  std::vector<SessionMark> marks;
  for (const SessionRow& row : rows) marks.push_back(row.mark);
  return SessionMarks::Create(std::move(marks));
}

}  // namespace dhpmap
