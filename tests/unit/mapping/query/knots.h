// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mapping/geometry/moving_sphere.h"

namespace dhpmap::testing {

/// Where a sphere is at a moment (0: at the first knot, 1: at the second, and so on) if it moves evenly between them.
inline SphereKnot KnotAt(const std::vector<SphereKnot>& knots, double at) {
  const auto i = std::min(static_cast<std::size_t>(at), knots.size() - 2);
  const double share = at - static_cast<double>(i);
  return {at, knots[i].center_m + share * (knots[i + 1].center_m - knots[i].center_m),
          knots[i].radius_m + share * (knots[i + 1].radius_m - knots[i].radius_m)};
}

}  // namespace dhpmap::testing
