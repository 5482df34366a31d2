// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/status.h"

namespace dhpmap {

/// Applies a setting such as "integration.max_range_m=4". INVALID_ARGUMENT for an unknown key, with a list of the known
/// ones, and for a value of another type; the server checks ranges.
Status ApplySetting(const std::string& key_value, v1::MapConfig& config);

/// All keys, sorted.
std::vector<std::string> SettingKeys();

}  // namespace dhpmap
