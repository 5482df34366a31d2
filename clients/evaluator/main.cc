// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-evaluate: scores maps of our system and of baselines against the ground truth of data sets.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "clients/command_line/typos.h"
#include "clients/command_line/version.h"
#include "clients/evaluator/paper_command.h"
#include "clients/evaluator/relations_command.h"
#include "clients/evaluator/run_command.h"

int main(int argc, char** argv) {
  constexpr int kFailed = 1, kUsage = 2;
  dhpmap::Status status;
  CLI::App app("Compares maps with the ground truth of a data set.", "dhpmap-evaluate");
  app.set_version_flag("--version", dhpmap::VersionOf("dhpmap-evaluate"));
  app.failure_message(dhpmap::ExplainParseError);
  app.require_subcommand(1);
  dhpmap::evaluator::AddRunCommand(app, status);
  dhpmap::evaluator::AddPaperCommand(app, status);
  dhpmap::evaluator::AddRelationsCommand(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  }
  if (status.ok()) return 0;
  std::fprintf(stderr, "dhpmap-evaluate: %s\n", status.ToString().c_str());
  return status.code() == dhpmap::StatusCode::kInvalidArgument ? kUsage : kFailed;
}
