// SPDX-License-Identifier: BSD-3-Clause
// dhpmap: the map server's client.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "clients/cli/connection.h"
#include "clients/command_line/typos.h"
#include "clients/command_line/version.h"

namespace {

/// CLI11 treats "-.5" as an option, but "-0.5" as a number.
std::string NumberSpelledOut(const std::string& argument) {
  const bool is_number =
      argument.size() > 2 && argument.starts_with("-.") && std::isdigit(static_cast<unsigned char>(argument[2]));
  return is_number ? "-0" + argument.substr(1) : argument;
}

/// The arguments in the order that CLI11 expects: last first.
std::vector<std::string> Arguments(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  std::reverse(arguments.begin(), arguments.end());
  std::transform(arguments.begin(), arguments.end(), arguments.begin(), NumberSpelledOut);
  return arguments;
}

/// Throws errors with their exit codes, for main.
void OpenOrThrow(dhpmap::Session& session) {
  const dhpmap::client::Status status = dhpmap::Open(session);
  if (status.ok()) return;
  const dhpmap::client::FieldViolation& wrong = status.violations.at(0);
  if (wrong.field == "token") {
    throw CLI::ValidationError("--token-file",
                               "the key would go to " + session.server + " in the clear: say whom to trust with --ca");
  }
  if (wrong.field != "ca_file") throw CLI::ValidationError("--token-file", wrong.description);
  dhpmap::ReportLocalError("--ca: " + wrong.description + ", so that no server is trusted");
  throw CLI::RuntimeError(static_cast<int>(dhpmap::ExitCode::kUnreachable));
}

}  // namespace

int main(int argc, char** argv) {
  using dhpmap::ExitCode;
  dhpmap::Session session;
  CLI::App app("Client of the DHP Map Server", "dhpmap");
  app.set_version_flag("--version", dhpmap::VersionOf("dhpmap"));
  app.failure_message(dhpmap::ExplainParseError);
  app.fallthrough();  // --server and --json are accepted anywhere
  app.require_subcommand(1);
  app.footer(dhpmap::ExitCodeHelp());
  app.add_option("--server", session.server, "Address of the server's gRPC door")
      ->envname("DHPMAP_SERVER")
      ->capture_default_str();
  app.add_option("--token-file", session.token_file, "File with your key, of mode 600")->type_name("FILE");
  app.parse_complete_callback([&app, &session] {
    if (!app.got_subcommand("doctor")) OpenOrThrow(session);  // doctor reports these errors itself
  });
  app.add_option("--ca", session.ca,
                 "PEM file of who signed the server's certificate, or 'system' for those this system trusts: with TLS")
      ->type_name("FILE");
  app.add_flag("--json", session.json, "Answer in JSON");
  dhpmap::AddMapCommand(app, session);
  dhpmap::AddMapsCommands(app, session);
  dhpmap::AddSubmapsCommand(app, session);
  dhpmap::AddQueryCommands(app, session);
  dhpmap::AddEditCommands(app, session);
  dhpmap::AddLogCommand(app, session);
  dhpmap::AddUndoCommands(app, session);
  dhpmap::AddRestoreCommand(app, session);
  dhpmap::AddExportCommands(app, session);
  dhpmap::AddBackupCommand(app, session);
  dhpmap::AddVerifyCommand(app, session);
  dhpmap::AddWatchCommand(app, session);
  dhpmap::AddSessionsCommands(app, session);
  dhpmap::AddFleetCommands(app, session);
  dhpmap::AddDoctorCommand(app, session);
  dhpmap::AddUiCommand(app, session);
  dhpmap::AddReplayCommand(app, session);
  dhpmap::AddKeysCommands(app, session);
  dhpmap::AddAuditCommand(app, session);
  dhpmap::AddCompletionCommand(app, session);
  try {
    app.parse(Arguments(argc, argv));
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  return static_cast<int>(session.exit_code);
}
