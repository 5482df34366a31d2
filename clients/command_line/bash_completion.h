// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace dhpmap {

/// Values that only the program knows, and the command of it that prints them, one per line.
struct ListedValues {
  std::string name;     ///< of options and positionals: "map" for both `map` and `--map`
  std::string command;  ///< "completion maps"
};

/// A bash completion script for `app`: commands, options, values of options that have a fixed set, values that `listed`
/// names, and files for all others.
std::string BashCompletion(const CLI::App& app, const ListedValues& listed);

}  // namespace dhpmap
