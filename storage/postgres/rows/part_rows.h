// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "storage/postgres/answer.h"
#include "storage/postgres/values.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {

/// The SELECTs of a map's parts by map_key ($1), in the order of MapParts; rows in the order of the checksums.
std::vector<Call> CallsForParts(std::int64_t map_key);
/// Reads their answers. DATA_LOSS for a malformed row.
Result<MapParts> ReadParts(std::span<Answer> answers);

}  // namespace dhpmap::postgres
