// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/rig/load/bulk_calls.h"

namespace dhpmap::rig {

// Attacks on HTTP/2 and on accepting, from the first frame on and for some seconds each: whoever ends the connection is
// met again at once. Each prints how far it came, and returns whether a client that came meanwhile was served.

/// Calls that are begun and reset at once (CVE-2023-44487).
bool ResetRapidly(const Target& target);
/// 40,000 calls of a client that acknowledges no SETTINGS.
bool LeaveSettingsUnacknowledged(const Target& target);
/// A header block without end.
bool ContinueHeadersForever(const Target& target);
/// A header value of declared length 2^31, and what there is of it.
bool DeclareHugeValue(const Target& target);
/// PING and SETTINGS, as many as go.
bool PingForever(const Target& target);
/// 1,000 connections that say nothing.
bool ConnectSilently(const Target& target);

}  // namespace dhpmap::rig
