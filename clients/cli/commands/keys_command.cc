// SPDX-License-Identifier: BSD-3-Clause
// dhpmap keys create|list|rotate|revoke: edits the server's key file on this machine, or the keys in a database.
// dhpmap whoami: the principal of a key.
#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/cli/connection.h"
#include "clients/cli/database_flag.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/auth_service.grpc.pb.h"
#include "server/auth/keys/key_book.h"
#include "server/auth/keys/key_file.h"
#include "server/auth/keys/key_table.h"
#include "server/auth/keys/utc_text.h"
#include "storage/auth_tables.h"

namespace dhpmap {
namespace {

struct KeyOptions {
  std::string file, database;  ///< one of them is empty
  std::string name;
  std::string role = "viewer";
  std::string expires = "90d", overlap = "24h";
  std::vector<std::string> maps = {"*"}, sessions;
};

std::int64_t Now_s() { return auth::SystemWallClock()(); }

Result<std::int64_t> ExpiryOf(const std::string& text) {
  if (text == "never") return auth::kNever_s;
  const auto duration_s = auth::DurationFromText(text);
  if (!duration_s) return InvalidArgument("'" + text + "' is no time: say 90d, 24h, 15m, 30s or never");
  return Now_s() + *duration_s;
}

ExitCode Report(const Status& status) {
  if (status.code() == StatusCode::kUnavailable) return ReportLocalError(status.message(), ExitCode::kUnreachable);
  const bool is_usage = status.code() == StatusCode::kInvalidArgument || status.code() == StatusCode::kNotFound;
  return ReportLocalError(status.message(), is_usage ? ExitCode::kUsage : ExitCode::kLocalFile);
}

/// Only the key goes to stdout, so that `> key.txt` captures nothing else.
ExitCode Show(const Session& session, const auth::ShownKey& key) {
  if (session.json) {
    std::cout << nlohmann::ordered_json{{"id", key.record.id}, {"name", key.record.name}, {"key", key.text}}.dump(1)
              << "\n";
    return ExitCode::kOk;
  }
  std::cerr << "Key " << key.record.id << " of " << key.record.name << ", role " << auth::NameOf(key.record.role)
            << ". It is shown this once; keep it in a file of mode 600, for --token-file.\n";
  std::cout << key.text << "\n";
  return ExitCode::kOk;
}

using Records = std::vector<auth::KeyRecord>;

Result<Records> ReadKeys(const KeyOptions& options) {
  if (options.database.empty()) {
    DHPMAP_ASSIGN_OR_RETURN(auth::KeyFileContent content, auth::ReadKeyFile(options.file));
    return std::move(content.records);
  }
  DHPMAP_ASSIGN_OR_RETURN(const auto tables, OpenAuthTables(options.database));
  DHPMAP_ASSIGN_OR_RETURN(auth::KeyTableContent content, auth::ReadKeyTable(*tables));
  return std::move(content.records);
}

Status ChangeKeys(const KeyOptions& options, const std::function<Status(Records&)>& change) {
  if (options.database.empty()) return auth::ChangeKeyFile(options.file, change);
  DHPMAP_ASSIGN_OR_RETURN(const auto tables, OpenAuthTables(options.database));
  return auth::ChangeKeyTable(*tables, change);
}

ExitCode RunCreate(const Session& session, const KeyOptions& options) {
  const auto role = auth::RoleFromName(options.role);
  if (!role) return ReportLocalError("the role is viewer, editor, robot or admin", ExitCode::kUsage);
  const auto expires_s = ExpiryOf(options.expires);
  if (!expires_s.ok()) return Report(expires_s.status());
  auth::ShownKey shown;
  const Status made = ChangeKeys(options, [&](Records& records) -> Status {
    const auth::NewKey key{.name = options.name,
                           .role = *role,
                           .maps = options.maps,
                           .sessions = options.sessions,
                           .expires_s = *expires_s};
    DHPMAP_ASSIGN_OR_RETURN(shown, AddKey(key, Now_s(), auth::SystemRandomness(), records));
    return Status::Ok();
  });
  return made.ok() ? Show(session, shown) : Report(made);
}

ExitCode RunRotate(const Session& session, const KeyOptions& options) {
  const auto overlap_s = auth::DurationFromText(options.overlap);
  if (!overlap_s) return ReportLocalError("'" + options.overlap + "' is no time: say 24h", ExitCode::kUsage);
  auth::ShownKey shown;
  const Status made = ChangeKeys(options, [&](Records& records) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(shown, RotateKey(options.name, *overlap_s, Now_s(), auth::SystemRandomness(), records));
    return Status::Ok();
  });
  return made.ok() ? Show(session, shown) : Report(made);
}

ExitCode RunRevoke(const KeyOptions& options) {
  int num_revoked = 0;
  const Status made = ChangeKeys(options, [&](Records& records) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(num_revoked, auth::RevokeKeys(options.name, Now_s(), records));
    return Status::Ok();
  });
  if (!made.ok()) return Report(made);
  std::cout << "revoked " << num_revoked << (num_revoked == 1 ? " key" : " keys") << " of " << options.name << "\n";
  return ExitCode::kOk;
}

std::string Joined(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) joined += (joined.empty() ? "" : ",") + text;
  return joined;
}

std::string StateOf(const auth::KeyRecord& record) {
  if (record.revoked_s) return "revoked " + auth::UtcText(*record.revoked_s);
  if (record.expires_s == auth::kNever_s) return "good";
  return (record.expires_s <= Now_s() ? "expired " : "until ") + auth::UtcText(record.expires_s);
}

ExitCode RunList(const Session& session, const KeyOptions& options) {
  const auto records = ReadKeys(options);
  if (!records.ok()) return Report(records.status());
  if (session.json) {
    nlohmann::ordered_json keys = nlohmann::ordered_json::array();
    for (const auth::KeyRecord& record : *records) {
      keys.push_back(nlohmann::ordered_json::parse(auth::LineOf(record)));
      keys.back().erase("sha256");
    }
    std::cout << keys.dump(1) << "\n";
    return ExitCode::kOk;
  }
  TextTable table({"ID", "NAME", "ROLE", "MAPS", "SESSIONS", "STATE"});
  for (const auth::KeyRecord& record : *records) {
    table.Add({record.id, record.name, std::string(auth::NameOf(record.role)), Joined(record.maps.texts()),
               Joined(record.sessions.texts()), StateOf(record)});
  }
  table.Print(std::cout);
  return ExitCode::kOk;
}

ExitCode RunWhoAmI(const Session& session) {
  return Tell(session, Ask(session, &v1::AuthService::Stub::WhoAmI, v1::WhoAmIRequest()),
              [&](const v1::WhoAmIResponse& response) {
                const auto joined = [](const auto& texts) { return Joined({texts.begin(), texts.end()}); };
                std::cout << response.principal() << ", a"
                          << (response.role() == "viewer" || response.role() == "robot" ? " " : "n ") << response.role()
                          << ", maps " << joined(response.map_patterns()) << ", sessions "
                          << joined(response.session_patterns());
                if (!response.key_id().empty()) std::cout << ", key " << response.key_id();
                if (response.has_expire_time())
                  std::cout << " until " << auth::UtcText(response.expire_time().seconds());
                std::cout << "\n";
              });
}

CLI::App* AddKeyCommand(CLI::App& keys, const char* name, const char* help, KeyOptions& options) {
  CLI::App* command = keys.add_subcommand(name, help);
  CLI::Option* file = command->add_option("--keys", options.file,
                                          "The server's file of keys: auth.keys, or DB.keys beside the database");
  AddDatabaseFlag(*command, options.database)->excludes(file);
  command->parse_complete_callback([&options] {
    if (options.file.empty() && options.database.empty()) throw CLI::RequiredError("--keys FILE or --db URL");
  });
  return command;
}

}  // namespace

void AddKeysCommands(CLI::App& app, Session& session) {
  CLI::App* keys =
      app.add_subcommand("keys", "Keys of servers, in a file or a database; they take them up within a second");
  keys->require_subcommand(1);
  auto options = std::make_shared<KeyOptions>();
  CLI::App* create = AddKeyCommand(*keys, "create", "Make a key and show it, once", *options);
  create->add_option("name", options->name, "Whose key: edits are logged under this name")->required();
  create->add_option("--role", options->role, "viewer, editor, robot or admin")->capture_default_str();
  create->add_option("--maps", options->maps, "Patterns of maps: 'site-*'; '!site-x' leaves out")
      ->delimiter(',')
      ->capture_default_str();
  create->add_option("--sessions", options->sessions, "Patterns of sessions [NAME,NAME-*]")->delimiter(',');
  create->add_option("--expires", options->expires, "After which time: 90d, 24h, never")->capture_default_str();
  create->callback([options, &session] { session.exit_code = RunCreate(session, *options); });
  CLI::App* list = AddKeyCommand(*keys, "list", "All keys: whose, what for, until when", *options);
  list->callback([options, &session] { session.exit_code = RunList(session, *options); });
  CLI::App* rotate =
      AddKeyCommand(*keys, "rotate", "Make a new key like the last one of a name, and show it", *options);
  rotate->add_option("name", options->name, "Whose key")->required();
  rotate->add_option("--overlap", options->overlap, "How long the old one stays good")->capture_default_str();
  rotate->callback([options, &session] { session.exit_code = RunRotate(session, *options); });
  CLI::App* revoke = AddKeyCommand(*keys, "revoke", "End keys for good: calls and streams within a second", *options);
  revoke->add_option("key", options->name, "Id of a key, or the name whose keys all end")->required();
  revoke->callback([options, &session] { session.exit_code = RunRevoke(*options); });
  app.add_subcommand("whoami", "What the server takes you for")->callback([&session] {
    session.exit_code = RunWhoAmI(session);
  });
}

}  // namespace dhpmap
