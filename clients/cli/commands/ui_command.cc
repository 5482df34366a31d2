// SPDX-License-Identifier: BSD-3-Clause
// dhpmap ui: prints or opens the viewer's link to a map.
#include <spawn.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <memory>
#include <string>

#include "clients/cli/connection.h"
#include "clients/cli/new_map.h"
#include "clients/cli/ui_link.h"

extern char** environ;  // NOLINT: name given by POSIX

namespace dhpmap {
namespace {

struct UiOptions {
  std::string map;
  std::string http;
  bool opens = false;
};

/// Opens the link with the desktop's handler. False if there is none.
bool OpenInBrowser(const std::string& link) {
  std::string program = "xdg-open", argument = link;
  std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

ExitCode Run(const Session& session, const UiOptions& options) {
  if (!options.map.empty()) {
    // A link to a missing map would show nothing.
    if (const auto map = GetMap(session, options.map); !map.ok()) return ReportError(session, map.status());
  }
  const std::string link = UiLink(options.http.empty() ? HttpOf(session.server) : options.http, options.map);
  if (session.json) std::cout << "{\"link\": \"" << link << "\"}\n";
  else std::cout << link << "\n";
  if (options.opens && !OpenInBrowser(link))
    return ReportLocalError("no browser could be opened: open the link in one");
  return ExitCode::kOk;
}

}  // namespace

void AddUiCommand(CLI::App& app, Session& session) {
  auto options = std::make_shared<UiOptions>();
  CLI::App* ui = app.add_subcommand("ui", "Print the link of the viewer in the browser");
  ui->add_option("map", options->map, "Name of the map; none: the one that was changed last");
  ui->add_option("--http", options->http,
                 "The server's REST door, as its log names it; default: port 8080 of the host of --server");
  ui->add_flag("--open", options->opens, "Open it, too");
  ui->callback([options, &session] { session.exit_code = Run(session, *options); });
}

}  // namespace dhpmap
