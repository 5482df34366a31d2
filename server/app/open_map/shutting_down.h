// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace dhpmap {

/// The error for calls and jobs once the server, or a map's writer, is stopping.
inline Status ShuttingDown() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

}  // namespace dhpmap
