// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "storage/check/verify.h"
#include "storage/postgres/values.h"

namespace dhpmap::postgres {

// The statements of a repair that read no other state of the map.

/// Deletes unreadable tiles and submaps with their remaining rows, and corrects the sizes of the others.
std::vector<Call> CallsToDrop(std::int64_t map_key, const Verification& found);
/// Counts the references of all blobs again, and removes rows that belong to no map.
std::vector<Call> CallsToCount(std::int64_t map_key, std::int64_t now_ns);

}  // namespace dhpmap::postgres
