// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "server/config/server_config.h"

namespace dhpmap {

/// Result of parsing a command line.
struct Invocation {
  ServerConfig config;
  bool is_done = false;   ///< do not serve: print `text` and exit
  bool is_check = false;  ///< do not serve: report errors and exit
  std::string text;       ///< help, version or --print-config
};

/// Parses the configuration: defaults < file (--config) < environment < flags. Validates it, naming every invalid key
/// at once. `environment`: strings "NAME=value". INVALID_ARGUMENT, NOT_FOUND.
Result<Invocation> ParseCommandLine(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& environment);

}  // namespace dhpmap
