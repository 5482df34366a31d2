// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/rig/load/bulk_calls.h"

namespace dhpmap::rig {

// What clients send and do not end, or send as one. Each takes less than 15 s, and returns whether the server answered
// as it should what is to be answered at all; otherwise says so.

/// 40 bodies of NDJSON whose one line has 32 MiB so far.
bool LeaveLinesUnfinished(const Target& target);
/// 8 bodies of NDJSON that are one line of 30 MB, good JSON, of a frame that is not usable.
bool SendLargeLines(const Target& target);
/// 64 gRPC messages of 60 MiB of which 1 MiB comes.
bool LeaveMessagesUnfinished(const Target& target);

}  // namespace dhpmap::rig
