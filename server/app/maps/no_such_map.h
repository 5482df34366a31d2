// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/status.h"

namespace dhpmap {

inline Status NoSuchMap(const std::string& name) {
  return NotFound("there is no map '" + name.substr(0, 80) + "'").WithReason("MAP_NOT_FOUND");
}

}  // namespace dhpmap
