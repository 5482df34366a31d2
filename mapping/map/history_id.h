// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// A new history for a map (MapInfo::history_id): random, above 0, of 63 bits.
std::uint64_t DrawHistoryId();

}  // namespace dhpmap
