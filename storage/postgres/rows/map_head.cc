// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/rows/map_head.h"

#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

const MoreColumns& Counters() {
  static const MoreColumns columns = {"map_key", "commit_id", "owner", "owner_epoch", "next_blob_key", "seen_ns"};
  return columns;
}

void PutCounters(const MapHead& head, Values& values) {
  values.Add(head.row.key).Add(head.commit_id).Add(head.owner).Add(head.owner_epoch);
  values.Add(head.next_blob_key).Add(head.seen_ns);
}

std::string ReplaceText() {
  const MoreColumns& counters = Counters();
  int number = 0;
  for (const ColumnName& column : Maps().columns()) number += column.written == Written::kAlways ? 1 : 0;
  number += static_cast<int>(counters.size());
  std::string conditions;
  for (const char* name : {"map_key", "owner_epoch", "commit_id", "revision"}) {
    conditions += std::string(conditions.empty() ? "" : " AND ") + name + " = $" + std::to_string(++number);
  }
  return "WITH replaced AS (UPDATE maps SET " + AssignmentsText(Maps(), counters) + " WHERE " + conditions +
         " RETURNING 1) SELECT 1 / count(*) FROM replaced";
}

}  // namespace

const std::string& HeadByKey() {
  static const std::string text = SelectText(Maps(), "WHERE map_key = $1", Counters());
  return text;
}

const std::string& HeadByName() {
  static const std::string text =
      SelectText(Maps(), "WHERE map_key = (SELECT n.map_key FROM map_names n WHERE n.name = $1)", Counters());
  return text;
}

const std::string& HeadsAfter() {
  // By an array and not by IN: PostgreSQL takes the unknown limit for a tenth of all maps, and would read every head.
  static const std::string text = SelectText(Maps(),
                                             "WHERE map_key = ANY (ARRAY(SELECT n.map_key FROM map_names n WHERE "
                                             "n.name > $1 ORDER BY n.name LIMIT $2)) ORDER BY name",
                                             Counters());
  return text;
}

bool ReadHead(Answer& answer, MapHead& head) {
  const bool is_read = ReadRow(Maps(), answer, head.row);
  head.row.key = answer.Int();
  head.commit_id = answer.Int();
  head.owner = answer.Int();
  head.owner_epoch = answer.Int();
  head.next_blob_key = answer.Int();
  head.seen_ns = answer.Int();
  return is_read;
}

Call InsertHead(const MapHead& head) {
  static const std::string text = InsertText(Maps(), Counters());
  Call call{&text};
  Maps().BindAll(head.row, call.values);
  PutCounters(head, call.values);
  return call;
}

Call ReplaceHead(const MapHead& before, const MapHead& after) {
  static const std::string text = ReplaceText();
  Call call{&text};
  Maps().BindChanges(after.row, call.values);
  PutCounters(after, call.values);
  call.values.Add(before.row.key).Add(before.owner_epoch).Add(before.commit_id).Add(before.row.info.revision);
  return call;
}

bool IsFenced(const std::string& sqlstate) { return sqlstate == "22012"; }

}  // namespace dhpmap::postgres
