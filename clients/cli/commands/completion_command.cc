// SPDX-License-Identifier: BSD-3-Clause
// dhpmap completion bash; the script calls completion maps for map names.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/command_line/bash_completion.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap {
namespace {

/// A user who presses Tab should not wait longer for an unreachable server.
constexpr double kPatience_s = 0.5;

/// Only safe map names are passed to the shell.
bool IsPlain(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_' || c == '.';
  });
}

/// Names of maps, one per line; only the first page. Prints nothing if there is no server.
ExitCode RunCompletionMaps(const Session& session) {
  const auto response =
      session.caller->Call(&v1::MapService::Stub::ListMaps, v1::ListMapsRequest(), kPatience_s, client::Again::kNo);
  if (!response.ok()) return ExitCodeOf(response.status().code);
  for (const v1::Map& map : response->maps()) {
    const std::string name = map.name().substr(std::min(map.name().size(), std::string("maps/").size()));
    if (IsPlain(name)) std::cout << name << "\n";
  }
  return ExitCode::kOk;
}

}  // namespace

void AddCompletionCommand(CLI::App& app, Session& session) {
  CLI::App* completion = app.add_subcommand("completion",
                                            "Print shell completions; add to ~/.bashrc:\n"
                                            "  source <(dhpmap completion bash)");
  completion->require_subcommand(1);
  completion->add_subcommand("bash", "Print the script for bash: commands, options, names of maps")->callback([&app] {
    std::cout << BashCompletion(app, {.name = "map", .command = "completion maps"});
  });
  completion->add_subcommand("maps", "Names of the maps")->group("")->callback([&session] {
    session.exit_code = RunCompletionMaps(session);
  });
}

}  // namespace dhpmap
