// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// A name for those who give keys to tiles in memory, see StoredKey; 0, which is none, once there were too many in this
/// process. Thread-safe.
std::uint16_t NextStoreNumber();

/// Threads that encode and decode for a store: beyond two they gain little.
int NumCodecThreads();

}  // namespace dhpmap
