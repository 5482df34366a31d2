// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "mapping/base/status.h"

namespace dhpmap {

/// UNAVAILABLE, reason OWNER_UNREACHABLE, with the time after which the client tries again.
inline Status OwnerUnreachable(std::string message) {
  return Unavailable(std::move(message)).WithReason("OWNER_UNREACHABLE").WithMetadata("retry_after_s", "1");
}

}  // namespace dhpmap
