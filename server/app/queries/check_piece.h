// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/base/status.h"

namespace dhpmap {

/// Size of a piece of a check, in units of WorkBudget.
struct CheckPiece {
  std::int64_t work = 100'000;  ///< approximate; 30 ms for large boxes
  bool may_overrun = true;      ///< run an item that alone exceeds it; else leave it to another piece
};

/// Limit of a whole check: 140 s of one core for large boxes, the most expensive ones. A deadline ends it earlier.
inline constexpr std::int64_t kMostCheckWork = 500'000'000;

/// RESOURCE_EXHAUSTED for a check beyond the limit. `field`: the list that is too long.
Status TooMuchWork(const char* field);

}  // namespace dhpmap
