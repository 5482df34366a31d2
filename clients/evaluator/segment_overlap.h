// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include "clients/evaluator/elements.h"

namespace dhpmap::evaluator {

/// Sizes of the segments (class and instance) of both sides and of their intersections, over the judged elements.
struct SegmentOverlap {
  std::map<ElementLabel, std::int64_t> truth, predicted;
  std::map<std::pair<ElementLabel, ElementLabel>, std::int64_t> shared;  ///< (truth, predicted), any classes

  [[nodiscard]] double Iou(const ElementLabel& truth_segment, const ElementLabel& predicted_segment) const;
};

SegmentOverlap CountSegments(std::span<const Element> elements);

}  // namespace dhpmap::evaluator
