// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "clients/simulator/renderer.h"
#include "mapping/shape/upright_box.h"

namespace dhpmap::simulator {

/// The observed part of an instance in the map frame: bounds of the exact surface points that pixels show.
struct SeenPart {
  ConvexOutline outline_m;  ///< from above
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;

  [[nodiscard]] bool IsEmpty() const { return outline_m.empty(); }
  void Join(const SeenPart& other);
  /// Must not be empty.
  [[nodiscard]] UprightBox Box() const { return BoxOver(outline_m, low_m, high_m); }
};

/// Indexed by instance id, with `num_instances` elements; element 0 stays empty.
std::vector<SeenPart> SeenParts(const RenderedFrame& frame, std::size_t num_instances);

}  // namespace dhpmap::simulator
