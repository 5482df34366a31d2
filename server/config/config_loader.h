// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/result.h"
#include "server/config/server_config.h"

namespace dhpmap {

/// Dotted keys with their values as text. Keys of map_defaults begin with "map_defaults.".
using KeyValues = std::vector<std::pair<std::string, std::string>>;

/// Flattens a YAML document of nested mappings. INVALID_ARGUMENT, with the line, for a syntax error, a duplicate key, a
/// second document, a recursive alias, or anything other than mappings and text.
Result<KeyValues> ParseYaml(const std::string& text);

/// Reads a file. NOT_FOUND if it cannot be read.
Result<std::string> ReadConfigFile(const std::string& path);

/// The keys that DHPMAP_ environment variables set. A variable that matches no key is listed under its own name, so
/// that ApplyKeyValues refuses it. `environment`: strings "NAME=value".
KeyValues KeysFromEnvironment(const std::vector<std::string>& environment);

/// Sets every key. INVALID_ARGUMENT, naming all unknown keys and malformed values; `source` is for the message. Does
/// not check ranges.
Status ApplyKeyValues(const KeyValues& values, const std::string& source, ServerConfig& config);

/// The whole configuration as YAML, with help for each key: the output of --print-config. Inverse of ParseYaml.
std::string ToYaml(const ServerConfig& config);

}  // namespace dhpmap
