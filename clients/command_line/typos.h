// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace dhpmap {

/// What to tell of a command line that `app` could not parse: a command or an option that is not there, with the one
/// that is spelled like it, or what CLI11 says. For App::failure_message.
std::string ExplainParseError(const CLI::App* app, const CLI::Error& error);

}  // namespace dhpmap
