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

/// Dotted keys and their values as text. Keys of map_defaults begin with "map_defaults.".
using KeyValues = std::vector<std::pair<std::string, std::string>>;

/// Flattens a YAML document of nested mappings. INVALID_ARGUMENT, which says the line, if it does not parse, has a key
/// twice, a second document or an alias that holds itself, or anything but mappings of text.
Result<KeyValues> ParseYaml(const std::string& text);

/// Reads a file. NOT_FOUND if it cannot be read.
Result<std::string> ReadConfigFile(const std::string& path);

/// The keys that the environment sets, as DHPMAP_...; a DHPMAP_ variable that names no key is in the list under its own
/// name, so that applying the list refuses it. `environment`: strings "NAME=value".
KeyValues KeysFromEnvironment(const std::vector<std::string>& environment);

/// Sets every key. INVALID_ARGUMENT naming all keys that are unknown and all values that do not parse; `source` goes
/// into the message. Does not check ranges.
Status ApplyKeyValues(const KeyValues& values, const std::string& source, ServerConfig& config);

/// The whole configuration as YAML, each key with its meaning: what --print-config prints. ParseYaml undoes it.
std::string ToYaml(const ServerConfig& config);

}  // namespace dhpmap
