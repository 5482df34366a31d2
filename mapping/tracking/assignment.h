// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/ids.h"

namespace dhpmap {

/// Where a segment of a frame goes.
struct Assignment {
  SubmapId submap;      ///< kUnknownSubmap: geometry only
  bool is_new = false;  ///< the submap was made for it
  float iou = 0;        ///< of the match; 0 where none was computed
};

}  // namespace dhpmap
