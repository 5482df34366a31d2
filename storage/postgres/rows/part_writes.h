// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "storage/postgres/values.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {

bool IsSameConfig(const MapParts& a, const MapParts& b);

/// Adds the statements that change a map's parts from `before` to `after`.
void WriteParts(const MapParts& before, const MapParts& after, std::vector<Call>& calls);
/// The same without the config.
void WritePartsBesideConfig(const MapParts& before, const MapParts& after, std::vector<Call>& calls);

}  // namespace dhpmap::postgres
