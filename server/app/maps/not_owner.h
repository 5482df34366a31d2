// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/status.h"

namespace dhpmap {

/// The error for work on a map that another process owns. `address`: the owner's; may be empty.
inline Status NotOwner(const std::string& map, const std::string& address) {
  Status status = Unavailable("map '" + map + "' is written by another server now").WithReason("NOT_OWNER");
  return address.empty() ? status : std::move(status).WithMetadata("owner", address);
}

}  // namespace dhpmap
