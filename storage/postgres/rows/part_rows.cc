// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/rows/part_rows.h"

#include <string>

#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

template <typename Row>
Status ReadRows(const Table<Row>& table, Answer& answer, std::vector<Row>& rows) {
  while (answer.Next()) {
    if (!ReadRow(table, answer, rows.emplace_back())) return DataLoss("a row of table " + std::string(table.table()));
  }
  return Status::Ok();
}

}  // namespace

std::vector<Call> CallsForParts(std::int64_t map_key) {
  static const std::string texts[] = {SelectText(ConfigTable(), "WHERE map_key = $1 ORDER BY key"),
                                      SelectText(Classes(), "WHERE map_key = $1 ORDER BY class_id"),
                                      SelectText(Sessions(), "WHERE map_key = $1 ORDER BY session"),
                                      SelectText(MergedTable(), "WHERE map_key = $1 ORDER BY merged_id"),
                                      SelectText(PairTable(), "WHERE map_key = $1 ORDER BY first_id, second_id"),
                                      SelectText(KeptClearTable(), "WHERE map_key = $1 ORDER BY name")};
  std::vector<Call> calls;
  for (const std::string& text : texts) calls.emplace_back(Call{&text}).values.Add(map_key);
  return calls;
}

Result<MapParts> ReadParts(std::span<Answer> answers) {
  MapParts parts;
  DHPMAP_RETURN_IF_ERROR(ReadRows(ConfigTable(), answers[0], parts.config));
  DHPMAP_RETURN_IF_ERROR(ReadRows(Classes(), answers[1], parts.classes));
  DHPMAP_RETURN_IF_ERROR(ReadRows(Sessions(), answers[2], parts.sessions));
  DHPMAP_RETURN_IF_ERROR(ReadRows(MergedTable(), answers[3], parts.merged));
  DHPMAP_RETURN_IF_ERROR(ReadRows(PairTable(), answers[4], parts.pairs));
  DHPMAP_RETURN_IF_ERROR(ReadRows(KeptClearTable(), answers[5], parts.kept_clear));
  return parts;
}

}  // namespace dhpmap::postgres
