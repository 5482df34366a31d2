// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "clients/evaluator/class_map.h"
#include "clients/evaluator/segment_overlap.h"

namespace dhpmap::evaluator {

/// Panoptic quality of one class (Kirillov et al. 2019).
struct ClassPanoptic {
  int num_matched = 0, num_false = 0, num_missed = 0;  ///< TP, FP, FN segments
  double sum_iou = 0;                                  ///< of the matched segments
  /// Whether the ground truth has a segment of the class that counts.
  bool is_present = false;
  [[nodiscard]] double sq() const { return num_matched == 0 ? 0.0 : sum_iou / num_matched; }
  [[nodiscard]] double rq() const;
  [[nodiscard]] double pq() const { return sq() * rq(); }
};

struct PanopticMean {
  double pq = 0, sq = 0, rq = 0;
  int num_classes = 0;
};

/// PQ, SQ and RQ as in SemanticKITTI's evaluation. Segments match if they have the same class and an IoU above 0.5; at
/// most one pair of each can. Unmatched segments with fewer than `min_elements` elements count neither as false nor as
/// missed. Means are over the classes of the ground truth.
struct PanopticScore {
  std::vector<ClassPanoptic> classes;  ///< by evaluated class
  PanopticMean all, things, stuff;
  std::set<std::pair<ElementLabel, ElementLabel>> matches;  ///< (truth, predicted)
};

PanopticScore ScorePanoptics(const SegmentOverlap& overlap, const ClassMap& classes, std::int64_t min_elements);

}  // namespace dhpmap::evaluator
