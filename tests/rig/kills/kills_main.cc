// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-rig-kills: kills a server again and again while clients work on it, and checks that it keeps what it told
// them.
#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>

#include "tests/rig/kills/kills.h"
#include "tests/support/scenes.h"

int main(int argc, char** argv) {
  dhpmap::rig::KillOptions options;
  CLI::App app{"Kills dhpmap-server with SIGKILL while clients feed, edit and read, and checks what they were told"};
  app.add_option("--kills", options.num_kills, "How often")->capture_default_str();
  app.add_option("--seed", options.seed, "Of all chances but those of the threads")->capture_default_str();
  app.add_option("--min-life", options.min_life_s, "Shortest life of a server in s")->capture_default_str();
  app.add_option("--max-life", options.max_life_s, "Longest")->capture_default_str();
  app.add_option("--editors", options.num_editors, "Clients that edit")->capture_default_str();
  app.add_option("--list-editors", options.num_list_editors, "Clients that edit by lists, and undo them")
      ->capture_default_str();
  app.add_option("--readers", options.num_readers, "Clients that read")->capture_default_str();
  app.add_option("--directory", options.directory, "For the database and the server's logs, which are left there");
  CLI11_PARSE(app, argc, argv);

  std::optional<dhpmap::testing::TempDir> temporary;
  if (options.directory.empty()) options.directory = temporary.emplace().path();
  std::filesystem::create_directories(options.directory);
  const dhpmap::rig::KillReport report = dhpmap::rig::RunKills(options, std::cerr);
  std::cout << ToText(report);
  return report.complaints.empty() ? 0 : 1;
}
