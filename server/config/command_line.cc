// SPDX-License-Identifier: BSD-3-Clause
#include "server/config/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <utility>

#include "mapping/base/near_name.h"
#include "server/config/config_loader.h"

namespace dhpmap {
namespace {

struct Flags {
  std::optional<std::string> config, db, grpc, http, log_level;
  bool log_json = false, insecure = false, no_tls = false, no_auth = false, no_backup = false, print_config = false,
       check_config = false;
  std::vector<std::string> set;
};

void AddFlags(CLI::App& app, Flags& flags) {
  app.set_version_flag("--version", std::string("dhpmap-server ") + DHPMAP_VERSION);
  app.add_option(
      "--db", flags.db,
      "SQLite file with the maps, made if it is not there; or (experimental) postgresql://... of a database");
  app.add_option("--config", flags.config, "YAML file; see deploy/dhpmap.yaml");
  app.add_option("--grpc", flags.grpc, "address of the gRPC door [127.0.0.1:50051]");
  app.add_option("--http", flags.http, "address of the REST door [127.0.0.1:8080]");
  app.add_flag("--insecure", flags.insecure, "the next two together");
  app.add_flag("--insecure-no-tls", flags.no_tls, "allow addresses that other machines can reach, without TLS");
  app.add_flag("--insecure-no-auth", flags.no_auth, "the same without keys");
  app.add_option("--log-level", flags.log_level, "debug, info, warning, error or off [info]");
  app.add_flag("--log-json", flags.log_json, "log one JSON object a line");
  app.add_option("--set", flags.set, "set any other key: --set store.commit_s=1")->type_name("KEY=VALUE");
  app.add_flag("--no-backup", flags.no_backup,
               "keep no copy of the database before a new version brings it up to date");
  app.add_flag("--check-config", flags.check_config,
               "look at all that a start would, say what is wrong, change nothing, and exit with 0 or 2");
  app.add_flag("--print-config", flags.print_config, "print the effective configuration as YAML and exit");
}

/// A suggestion for the first unknown flag: the one spelled most like it.
std::string NearFlag(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const std::string& word : app.remaining()) {
    if (word.starts_with("--")) return DidYouMean(word.substr(0, word.find('=')), names);
  }
  return {};
}

KeyValues KeysFromFlags(const Flags& flags) {
  KeyValues values;
  for (const std::string& item : flags.set) {
    const std::size_t equals = item.find('=');
    values.emplace_back(item.substr(0, equals), equals == std::string::npos ? "" : item.substr(equals + 1));
  }
  const auto add = [&values](const char* key, const std::optional<std::string>& value) {
    if (value) values.emplace_back(key, *value);
  };
  add("db", flags.db);
  add("grpc.address", flags.grpc);
  add("http.address", flags.http);
  add("log.level", flags.log_level);
  if (flags.log_json) values.emplace_back("log.json", "true");
  if (flags.insecure) values.emplace_back("insecure", "true");
  if (flags.no_tls) values.emplace_back("insecure_no_tls", "true");
  if (flags.no_auth) values.emplace_back("insecure_no_auth", "true");
  if (flags.no_backup) values.emplace_back("store.backup_before_upgrade", "false");
  return values;
}

/// Merges the messages of several statuses into one.
void AddTo(Status& all, const Status& status) {
  if (status.ok()) return;
  if (all.ok()) {
    all = status;
    return;
  }
  for (const FieldViolation& violation : status.violations()) all.AddViolation(violation.field, violation.description);
}

Result<ServerConfig> Merge(const Flags& flags, const std::vector<std::string>& environment) {
  ServerConfig config;
  Status bad;
  if (flags.config) {
    DHPMAP_ASSIGN_OR_RETURN(const std::string text, ReadConfigFile(*flags.config));
    DHPMAP_ASSIGN_OR_RETURN(const KeyValues values, ParseYaml(text));
    AddTo(bad, ApplyKeyValues(values, *flags.config, config));
  }
  AddTo(bad, ApplyKeyValues(KeysFromEnvironment(environment), "the environment", config));
  AddTo(bad, ApplyKeyValues(KeysFromFlags(flags), "the flags", config));
  AddTo(bad, config.Validate());
  if (!bad.ok()) return bad;
  return config;
}

}  // namespace

Result<Invocation> ParseCommandLine(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& environment) {
  CLI::App app("Builds, keeps and answers for hierarchical panoptic maps, over gRPC and REST.", "dhpmap-server");
  Flags flags;
  AddFlags(app, flags);
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // the order that CLI11 expects
    app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    return Invocation{.is_done = true, .text = app.help()};
  } catch (const CLI::CallForVersion& version) {
    return Invocation{.is_done = true, .text = std::string(version.what()) + "\n"};
  } catch (const CLI::Error& error) {
    const std::string near = NearFlag(app);
    return InvalidArgument(error.what() + (near.empty() ? "; --help lists the flags" : near));
  }
  DHPMAP_ASSIGN_OR_RETURN(ServerConfig config, Merge(flags, environment));
  if (flags.print_config) return Invocation{.config = config, .is_done = true, .text = ToYaml(config)};
  if (config.db.empty()) {
    return InvalidArgument("no database: say --db FILE").WithViolation("db", "is required");
  }
  return Invocation{.config = std::move(config), .is_check = flags.check_config};
}

}  // namespace dhpmap
