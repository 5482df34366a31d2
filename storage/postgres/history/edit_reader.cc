// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/edit_reader.h"

#include <limits>
#include <utility>

#include "storage/history/logged_edit.h"
#include "storage/postgres/reading/head_reader.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/rows/table_text.h"
#include "storage/rows/edit_rows.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadEditsTask[] = "read the log of edits";

/// The rows that belong to a row of the edit log.
struct EditMarks {
  bool is_undone = false, is_kept = false;
};

std::string EditsText(const char* which) {
  const std::string marks =
      "(SELECT t.kind FROM edit_targets t WHERE t.map_key = edits.map_key AND t.target = edits.revision ORDER BY "
      "t.revision DESC LIMIT 1)";
  const std::string kept =
      "EXISTS (SELECT 1 FROM edit_histories h WHERE h.map_key = edits.map_key AND h.edit_key = edits.revision)";
  return SelectText(Edits(), which, {"coalesce(" + marks + ", -1)", kept});
}

Result<EditRow> EditAt(Answer& answer, const std::string& map, EditMarks& marks) {
  EditRow row;
  const bool is_read = ReadRow(Edits(), answer, row);
  marks.is_undone = answer.Int() == static_cast<std::int64_t>(EditKind::kUndo);
  marks.is_kept = answer.Int() != 0;
  DHPMAP_RETURN_IF_ERROR(CheckEdit(is_read, row, map));
  return row;
}

}  // namespace

Result<std::vector<LoggedEdit>> ReadEditLog(Connection& connection, const std::string& name, const EditQuery& query) {
  static const std::string all = EditsText("WHERE map_key = $1 AND revision < $2 ORDER BY revision DESC LIMIT $3");
  static const std::string of_author =
      EditsText("WHERE map_key = $1 AND revision < $2 AND author = $4 ORDER BY revision DESC LIMIT $3");
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadHeadOf(connection, name));
  Call call{query.author ? &of_author : &all};
  call.values.Add(head.row.key).Add(query.before_revision.value_or(std::numeric_limits<std::int64_t>::max()));
  call.values.Add(query.max_edits);
  if (query.author) call.values.Add(*query.author);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadEditsTask));
  std::vector<LoggedEdit> edits;
  while (answer.Next()) {
    EditMarks marks;
    DHPMAP_ASSIGN_OR_RETURN(const EditRow row, EditAt(answer, name, marks));
    DHPMAP_ASSIGN_OR_RETURN(LoggedEdit edit, LoggedEditOf(row, name));
    edit.is_undone = marks.is_undone;
    edit.is_kept = marks.is_kept;
    edits.push_back(std::move(edit));
  }
  return edits;
}

Result<std::optional<StoredAnswer>> ReadStoredAnswer(Connection& connection, const std::string& name,
                                                     const std::string& request_id) {
  static const std::string text =
      EditsText("WHERE map_key = $1 AND request_id = $2 AND request_id <> '' ORDER BY revision DESC LIMIT 1");
  DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadHeadOf(connection, name));
  Call call{&text};
  call.values.Add(head.row.key).Add(request_id);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadEditsTask));
  if (!answer.Next()) return std::optional<StoredAnswer>();
  EditMarks marks;
  DHPMAP_ASSIGN_OR_RETURN(const EditRow row, EditAt(answer, name, marks));
  return std::optional(AnswerOf(row));
}

}  // namespace dhpmap::postgres
