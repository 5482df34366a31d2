// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/base/status.h"

namespace dhpmap {

/// How far a check goes at a time, in units of WorkBudget.
struct CheckPiece {
  std::int64_t work = 100'000;  ///< about so much; 30 ms for large boxes
  bool may_overrun = true;      ///< what takes more alone is done all the same; else it is left to another piece
};

/// What all of a check may cost: 140 s of one core for large boxes, which cost most a unit. A deadline ends it earlier.
inline constexpr std::int64_t kMostCheckWork = 500'000'000;

/// RESOURCE_EXHAUSTED, for what would cost more. `field`: of what there is too much.
Status TooMuchWork(const char* field);

}  // namespace dhpmap
