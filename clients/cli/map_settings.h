// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/status.h"

namespace dhpmap {

/// Applies "integration.max_range_m=4" and the like. INVALID_ARGUMENT for a key that is not there, with those that are,
/// and for a value of another type; ranges are the server's business.
Status ApplySetting(const std::string& key_value, v1::MapConfig& config);

/// All keys, sorted.
std::vector<std::string> SettingKeys();

}  // namespace dhpmap
