// SPDX-License-Identifier: BSD-3-Clause
// dhpmap audit: lists who changed what, and who was refused, from the database of servers that share one.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/cli/connection.h"
#include "clients/cli/database_flag.h"
#include "clients/cli/text_table.h"
#include "server/auth/keys/utc_text.h"
#include "storage/auth_tables.h"

namespace dhpmap {
namespace {

struct AuditOptions {
  std::string database, since, principal, map;
  int limit = 50;
};

void PrintAsJson(const std::vector<AuditRow>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const AuditRow& row : rows) {
    nlohmann::ordered_json json;
    json["time"] = auth::UtcText(row.time_s);
    json["server"] = "servers/" + std::to_string(row.server);
    if (!row.principal.empty()) json["principal"] = row.principal;
    if (!row.key_id.empty()) json["key"] = row.key_id;
    json["rpc"] = row.rpc;
    if (!row.map.empty()) json["map"] = row.map;
    json["decision"] = row.decision;
    if (row.num_left_out > 0) json["left_out"] = row.num_left_out;
    all.push_back(std::move(json));
  }
  std::cout << all.dump(1) << "\n";
}

void PrintAsTable(const std::vector<AuditRow>& rows) {
  TextTable table({"TIME", "PRINCIPAL", "KEY", "RPC", "MAP", "DECISION"});
  const auto or_dash = [](const std::string& text) { return text.empty() ? std::string("-") : text; };
  for (const AuditRow& row : rows) {
    table.Add({auth::UtcText(row.time_s), or_dash(row.principal), or_dash(row.key_id), row.rpc, or_dash(row.map),
               row.decision + (row.num_left_out > 0 ? " (" + std::to_string(row.num_left_out) + " left out)" : "")});
  }
  table.Print(std::cout);
}

Result<std::vector<AuditRow>> ReadRows(const AuditOptions& options) {
  AuditQuery query{.principal = options.principal, .map = options.map, .max = options.limit};
  if (!options.since.empty()) {
    const auto age_s = auth::DurationFromText(options.since);
    if (!age_s) return InvalidArgument("'" + options.since + "' is no time: say 90d, 24h, 15m or 30s");
    query.since_s = auth::SystemWallClock()() - *age_s;
  }
  DHPMAP_ASSIGN_OR_RETURN(const auto tables, OpenAuthTables(options.database));
  return tables->ListAudit(query);
}

ExitCode RunAudit(const Session& session, const AuditOptions& options) {
  const auto rows = ReadRows(options);
  if (!rows.ok()) {
    const StatusCode code = rows.status().code();
    return ReportLocalError(rows.status().message(), code == StatusCode::kInvalidArgument ? ExitCode::kUsage
                                                     : code == StatusCode::kUnavailable   ? ExitCode::kUnreachable
                                                                                          : ExitCode::kLocalFile);
  }
  if (session.json) PrintAsJson(*rows);
  else PrintAsTable(*rows);
  return ExitCode::kOk;
}

}  // namespace

void AddAuditCommand(CLI::App& app, Session& session) {
  CLI::App* audit = app.add_subcommand(
      "audit", "Calls that changed something or were refused, of all servers on one database, the newest first");
  auto options = std::make_shared<AuditOptions>();
  AddDatabaseFlag(*audit, options->database)->required();
  audit->add_option("--since", options->since, "No older than this: 90d, 24h, 15m");
  audit->add_option("--principal", options->principal, "Calls of this principal only");
  audit->add_option("--map", options->map, "Calls that name this map only");
  audit->add_option("-n,--limit", options->limit, "So many at most [50]")->check(CLI::Range(1, 100'000));
  audit->callback([options, &session] { session.exit_code = RunAudit(session, *options); });
}

}  // namespace dhpmap
