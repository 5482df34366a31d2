// SPDX-License-Identifier: BSD-3-Clause
// dhpmap doctor: checks a server and gives advice.
#include <CLI/CLI.hpp>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/doctor/examination.h"
#include "clients/command_line/version.h"

namespace dhpmap {
namespace {

client::ConnectOptions OptionsOf(const Session& session) {
  client::ConnectOptions options{.connect_s = 5, .deadline_s = 10};
  options.token_file = session.token_file;
  options.tls = session.ca == "system";
  if (session.ca != "system") options.ca_file = session.ca;
  return options;
}

/// Exit codes of this command only: 0 healthy, 1 a warning, 2 a failure.
ExitCode RunDoctor(const Session& session) {
  const std::string program = VersionOf("dhpmap");
  const std::vector<Finding> findings =
      Examine(session.server, session.ca, OptionsOf(session), program.substr(program.find(' ') + 1));
  std::cout << (session.json ? FindingsJson(findings) : FindingsText(findings));
  return static_cast<ExitCode>(WorstOf(findings));
}

}  // namespace

void AddDoctorCommand(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "doctor", "See whether the server is well: connection, certificate, versions, clock, disk, saving and feeds");
  command->footer("It ends with 0 if all is well, 1 if there is a warning, and 2 if something is wrong.");
  command->callback([&session] { session.exit_code = RunDoctor(session); });
}

}  // namespace dhpmap
