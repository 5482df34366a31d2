// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace dhpmap {

/// What completes values that only the program knows, as a command of it that prints them, a line each.
struct ListedValues {
  std::string name;     ///< of options and positionals: "map" for both `map` and `--map`
  std::string command;  ///< "completion maps"
};

/// A script for bash that completes the commands and options of a program, the values of options that have a set of
/// them, values that `listed` names, and files for all else. Made of `app` itself: it knows all that this knows.
std::string BashCompletion(const CLI::App& app, const ListedValues& listed);

}  // namespace dhpmap
