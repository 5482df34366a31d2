// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "clients/simulator/renderer.h"
#include "mapping/shape/upright_box.h"

namespace dhpmap::simulator {

/// What images show of an instance, map frame: around the points on its surface that pixels meet, exactly.
struct SeenPart {
  ConvexOutline outline_m;  ///< from above
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;

  [[nodiscard]] bool IsEmpty() const { return outline_m.empty(); }
  void Join(const SeenPart& other);
  /// Of one that is not empty.
  [[nodiscard]] UprightBox Box() const { return BoxOver(outline_m, low_m, high_m); }
};

/// By instance id, `num_instances` long; number 0 stays empty.
std::vector<SeenPart> SeenParts(const RenderedFrame& frame, std::size_t num_instances);

}  // namespace dhpmap::simulator
