// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace dhpmap {

/// The message for a command line that `app` could not parse: an unknown command or option with a suggestion, else the
/// text of CLI11. For App::failure_message.
std::string ExplainParseError(const CLI::App* app, const CLI::Error& error);

}  // namespace dhpmap
