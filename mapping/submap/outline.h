// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/shape/upright_box.h"

namespace dhpmap {

/// How an object stands, in a frame whose z is up.
struct SubmapOutline {
  UprightBox box;                          ///< upright, of the least area from above
  ConvexOutline footprint_m;               ///< from above, counterclockwise, within the box
  std::optional<double> support_height_m;  ///< z of its upper side (SupportHeight)
};

}  // namespace dhpmap
