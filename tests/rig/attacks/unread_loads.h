// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/rig/load/bulk_calls.h"

namespace dhpmap::rig {

// Of clients in processes of their own, until these are killed.

/// Streams of queries, each with a pin, that go on asking what is large and read nothing.
void HoldQueryStreams(const Target& target, int num_streams);
/// Watches from the first revision on that read nothing.
void HoldWatches(const Target& target, int num_watches);

/// Of the rig itself: begins so many watches over REST that read nothing, and edits all objects of the map again and
/// again for `seconds`. Whether the edits were made; otherwise says so.
bool EditWhileNobodyReads(const Target& target, int num_watches, double seconds);

}  // namespace dhpmap::rig
