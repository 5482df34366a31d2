// SPDX-License-Identifier: BSD-3-Clause
// dhpmap: the map server's client.
#include <CLI/CLI.hpp>

#include "clients/cli/connection.h"

int main(int argc, char** argv) {
  using dhpmap::ExitCode;
  dhpmap::Session session;
  CLI::App app("Client of the DHP Map Server", "dhpmap");
  app.fallthrough();  // --server and --json may stand anywhere
  app.require_subcommand(1);
  app.footer(dhpmap::ExitCodeHelp());
  app.add_option("--server", session.server, "Address of the server's gRPC door")
      ->envname("DHPMAP_SERVER")
      ->capture_default_str();
  app.add_flag("--json", session.json, "Answer in JSON");
  dhpmap::AddMapCommand(app, session);
  dhpmap::AddMapsCommands(app, session);
  dhpmap::AddSubmapsCommand(app, session);
  dhpmap::AddQueryCommands(app, session);
  dhpmap::AddEditCommands(app, session);
  dhpmap::AddExportCommands(app, session);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  return static_cast<int>(session.exit_code);
}
