// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mapping/map/map.h"
#include "storage/rows/config_rows.h"

namespace dhpmap::testing {

/// All that a map of schema 1 held, as lines of text without loss, but for its config: rows, for each block the number
/// of voxels and a checksum over all their values, and the values of a few voxels in full. What later versions add to a
/// map is not in it, so the text of a released database stays what it is.
std::string TextOf(const MapSnapshot& map);
/// Its config as it is stored: lines "config KEY = VALUE".
std::string TextOf(const std::vector<ConfigRow>& config);

}  // namespace dhpmap::testing
