// SPDX-License-Identifier: BSD-3-Clause
#include "storage/history/edit_log.h"

#include <limits>
#include <utility>

#include "storage/rows/edit_rows.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadEditsTask[] = "read the log of edits";
constexpr char kWriteEditsTask[] = "write the log of edits";
constexpr char kTrimEditsTask[] = "delete edits of long ago from their log";

/// Limit of edits trimmed with one edit.
constexpr int kMostEditsTrimmed = 16;

Status InsertTargets(Database& database, std::int64_t map_key, const EditEntry& entry) {
  if (entry.summary.targets.empty()) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(
      Statement insert,
      database.Prepare("INSERT OR REPLACE INTO edit_targets (map_key, target, revision, kind) VALUES (?, ?, ?, ?)",
                       kWriteEditsTask));
  for (const std::int64_t target : entry.summary.targets) {
    insert.Bind(map_key).Bind(target).Bind(entry.revision).Bind(static_cast<std::int64_t>(entry.summary.kind));
    DHPMAP_RETURN_IF_ERROR(insert.Run());
  }
  return Status::Ok();
}

/// Always keeps the newest edit: it was made, and its request may be repeated.
Status TrimEdits(Database& database, std::int64_t map_key, std::int64_t newest, std::int64_t now_ns,
                 const EditLogLimits& limits) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement oldest,
      database.Prepare("SELECT edit_key, seen_ns, num_edits, edit_bytes FROM edits JOIN edit_totals USING (map_key) "
                       "WHERE map_key = ? AND edit_key <> ? ORDER BY revision LIMIT 1",
                       kTrimEditsTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase, database.Prepare("DELETE FROM edits WHERE edit_key = ?", kTrimEditsTask));
  for (int n = 0; n < kMostEditsTrimmed; ++n) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, oldest.Bind(map_key).Bind(newest).Step());
    if (!has_row) return Status::Ok();
    const std::int64_t key = oldest.Int(0);
    const bool is_beyond = IsBeyond(limits, oldest.Int(2), oldest.Int(3), oldest.Int(1), now_ns);
    oldest.Reset();
    if (!is_beyond) return Status::Ok();
    DHPMAP_RETURN_IF_ERROR(erase.Bind(key).Run());
  }
  return Status::Ok();
}

/// Whether each target was undone last, or redone.
class TargetStates {
 public:
  static Result<TargetStates> Prepare(Database& database) {
    DHPMAP_ASSIGN_OR_RETURN(Statement select,
                            database.Prepare("SELECT kind FROM edit_targets WHERE map_key = ? AND target = ? ORDER BY "
                                             "revision DESC LIMIT 1",
                                             kReadEditsTask));
    return TargetStates(std::move(select));
  }
  Result<bool> IsUndone(std::int64_t map_key, std::int64_t revision) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select_.Bind(map_key).Bind(revision).Step());
    const bool is_undone = has_row && select_.Int(0) == static_cast<std::int64_t>(EditKind::kUndo);
    select_.Reset();
    return is_undone;
  }

 private:
  explicit TargetStates(Statement select) : select_(std::move(select)) {}
  Statement select_;
};

/// Reads the current row of the statement.
Result<EditRow> IntactEdit(const Statement& select, const std::string& map) {
  EditRow row;
  const bool is_read = Edits().Read(select, row);
  DHPMAP_RETURN_IF_ERROR(CheckEdit(is_read, row, map));
  return row;
}

}  // namespace

Result<std::int64_t> RecordEdit(Database& database, std::int64_t map_key, const EditRecord& edit, std::int64_t now_ns,
                                const EditLogLimits& limits) {
  const EditEntry& entry = edit.entry;
  const EditRow row = EditRowOf(map_key, edit, now_ns);
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, database.Prepare(Edits().Insert(), kWriteEditsTask));
  Edits().BindAll(row, insert);
  DHPMAP_RETURN_IF_ERROR(insert.Run());
  const std::int64_t key = database.LastInsertRowId();
  DHPMAP_RETURN_IF_ERROR(InsertTargets(database, map_key, entry));
  DHPMAP_RETURN_IF_ERROR(TrimEdits(database, map_key, key, now_ns, limits));
  return key;
}

Result<std::vector<LoggedEdit>> ReadEdits(Database& database, const MapRow& map, const EditQuery& query) {
  DHPMAP_ASSIGN_OR_RETURN(TargetStates states, TargetStates::Prepare(database));
  const char* const which = query.author
                                ? "WHERE map_key = ? AND revision < ? AND author = ? ORDER BY revision DESC LIMIT ?"
                                : "WHERE map_key = ? AND revision < ? ORDER BY revision DESC LIMIT ?";
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare(Edits().Select(which), kReadEditsTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement kept,
                          database.Prepare("SELECT 1 FROM edit_histories WHERE edit_key = ?", kReadEditsTask));
  select.Bind(map.key).Bind(query.before_revision.value_or(std::numeric_limits<std::int64_t>::max()));
  if (query.author) select.Bind(std::string_view(*query.author));
  select.Bind(query.max_edits);
  std::vector<LoggedEdit> edits;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return edits;
    DHPMAP_ASSIGN_OR_RETURN(EditRow row, IntactEdit(select, map.info.name));
    DHPMAP_ASSIGN_OR_RETURN(LoggedEdit edit, LoggedEditOf(row, map.info.name));
    DHPMAP_ASSIGN_OR_RETURN(edit.is_undone, states.IsUndone(map.key, row.revision));
    DHPMAP_ASSIGN_OR_RETURN(edit.is_kept, kept.Bind(row.key).Step());
    kept.Reset();
    edits.push_back(std::move(edit));
  }
}

Result<std::optional<StoredAnswer>> ReadAnswer(Database& database, const MapRow& map, const std::string& request_id) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare(
          Edits().Select("WHERE map_key = ? AND request_id = ? AND request_id <> '' ORDER BY revision DESC LIMIT 1"),
          kReadEditsTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map.key).Bind(std::string_view(request_id)).Step());
  if (!has_row) return std::optional<StoredAnswer>();
  DHPMAP_ASSIGN_OR_RETURN(const EditRow row, IntactEdit(select, map.info.name));
  return std::optional(AnswerOf(row));
}

}  // namespace dhpmap
