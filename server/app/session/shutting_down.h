// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace dhpmap {

/// What calls and jobs are refused with once the server, or a map's writer, has begun to stop.
inline Status ShuttingDown() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

}  // namespace dhpmap
