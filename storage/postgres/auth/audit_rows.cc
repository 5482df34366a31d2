// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/auth/audit_rows.h"

#include "storage/postgres/transaction_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kWriteAuditTask[] = "write the audit log";
constexpr char kReadAuditTask[] = "read the audit log";
const std::string kAppendAudit =
    "INSERT INTO audit_rows (time_s, server, number, principal, key_id, rpc, map, decision, num_left_out) VALUES ($1, "
    "$2, $3, $4, $5, $6, $7, $8, $9) ON CONFLICT DO NOTHING";
const std::string kListAudit =
    "SELECT time_s, server, number, principal, key_id, rpc, map, decision, num_left_out FROM audit_rows WHERE time_s "
    ">= $1 AND ($2 = '' OR principal = $2) AND ($3 = '' OR map = $3) ORDER BY time_s DESC, server DESC, number DESC "
    "LIMIT $4";
const std::string kDeleteAuditBefore = "DELETE FROM audit_rows WHERE time_s < $1";
const std::string kDeleteAuditBeyond =
    "DELETE FROM audit_rows WHERE time_s <= (SELECT time_s FROM audit_rows ORDER BY time_s DESC OFFSET $1 LIMIT 1)";

AuditRow ReadAuditRow(Answer& answer) {
  AuditRow row;
  row.time_s = answer.Int();
  row.server = answer.Int();
  row.number = answer.Int();
  row.principal = answer.Text();
  row.key_id = answer.Text();
  row.rpc = answer.Text();
  row.map = answer.Text();
  row.decision = answer.Text();
  row.num_left_out = answer.Int();
  return row;
}

}  // namespace

Status AppendAuditRows(Connection& connection, std::span<const AuditRow> rows) {
  std::vector<Call> calls = {{&BeginText()}};
  for (const AuditRow& row : rows) {
    Values& values = calls.emplace_back(Call{&kAppendAudit}).values;
    values.Add(row.time_s).Add(row.server).Add(row.number).Add(row.principal).Add(row.key_id);
    values.Add(row.rpc).Add(row.map).Add(row.decision).Add(row.num_left_out);
  }
  calls.push_back({&CommitText()});
  return connection.Run(calls, kWriteAuditTask).status;
}

Result<std::vector<AuditRow>> ReadAuditRows(Connection& connection, const AuditQuery& query) {
  Call call{&kListAudit};
  call.values.Add(query.since_s).Add(query.principal).Add(query.map).Add(query.max);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadAuditTask));
  std::vector<AuditRow> rows;
  while (answer.Next()) rows.push_back(ReadAuditRow(answer));
  return rows;
}

Status DeleteOldAuditRows(Connection& connection, std::int64_t oldest_s, std::int64_t most_rows) {
  std::vector<Call> calls = {{&kDeleteAuditBefore}, {&kDeleteAuditBeyond}};
  calls[0].values.Add(oldest_s);
  calls[1].values.Add(most_rows);
  return connection.Run(calls, kWriteAuditTask).status;
}

}  // namespace dhpmap::postgres
