// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/map/map.h"

namespace dhpmap {

// Preconditions of a commit for every MapStore.

/// INVALID_ARGUMENT unless both are states of one map, the later one not older.
Status ValidateCommit(const MapInfo& before, const MapInfo& after);

/// FAILED_PRECONDITION unless `before` is the stored state of the map.
Status ValidateBase(const MapInfo& before, std::int64_t stored_revision, std::int64_t stored_create_time_ns);

}  // namespace dhpmap
