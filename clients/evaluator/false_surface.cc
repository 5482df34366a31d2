// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/false_surface.h"

#include <cmath>
#include <cstddef>

namespace dhpmap::evaluator {

LabelCounts FalseSurface(std::span<const Neighbour> from_predicted, const std::vector<ElementLabel>& labels,
                         double d_match_m, double elements_a_sample) {
  LabelCounts counts;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_near = from_predicted[i].exists() && from_predicted[i].distance_m <= d_match_m;
    if (labels[i].class_index != ClassMap::kNone && !is_near) ++counts[labels[i]];
  }
  for (auto& [label, count] : counts) {
    count = static_cast<std::int64_t>(std::ceil(elements_a_sample * static_cast<double>(count)));
  }
  return counts;
}

}  // namespace dhpmap::evaluator
