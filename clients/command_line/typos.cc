// SPDX-License-Identifier: BSD-3-Clause
#include "clients/command_line/typos.h"

#include <CLI/CLI.hpp>
#include <vector>

#include "mapping/base/near_name.h"

namespace dhpmap {
namespace {

/// The last command that was parsed before the error.
const CLI::App& Reached(const CLI::App& app) {
  const CLI::App* reached = &app;
  while (!reached->get_subcommands().empty()) reached = reached->get_subcommands().back();
  return *reached;
}

std::string FullName(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent == nullptr ? "" : FullName(*parent) + " ") + command.get_name();
}

std::vector<std::string> CommandNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : command.get_subcommands({})) {
    if (!sub->get_group().empty()) names.push_back(sub->get_name());  // others are hidden
  }
  return names;
}

/// Includes options of the parent commands.
std::vector<std::string> OptionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent()) {
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  return names;
}

std::string Listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Empty if no word looks misspelled.
std::string TellTypo(const CLI::App& app) {
  const CLI::App& command = Reached(app);
  const std::vector<std::string> left = app.remaining(/*recurse=*/true);
  for (const std::string& word : left) {
    if (!word.starts_with("-") || word.size() < 2) continue;
    const std::string name = word.substr(0, word.find('='));
    return FullName(command) + " has no option '" + name + "'" + DidYouMean(name, OptionNames(command));
  }
  const std::vector<std::string> commands = CommandNames(command);
  if (left.empty() || commands.empty()) return {};
  const std::string near = DidYouMean(left.front(), commands);
  return FullName(command) + " has no command '" + left.front() + "'" +
         (near.empty() ? "; its commands: " + Listed(commands) : near);
}

}  // namespace

std::string ExplainParseError(const CLI::App* app, const CLI::Error& error) {
  const std::string typo = TellTypo(*app);
  if (typo.empty()) return CLI::FailureMessage::simple(app, error);
  return typo + "\nRun with --help for more information.\n";
}

}  // namespace dhpmap
