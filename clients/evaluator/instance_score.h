// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "clients/evaluator/class_map.h"
#include "clients/evaluator/segment_overlap.h"

namespace dhpmap::evaluator {

/// Average precision at one IoU.
struct PrecisionAt {
  double iou = 0;
  std::vector<std::optional<double>> classes;  ///< by evaluated class; none for stuff and for things that do not occur
  double mean = 0;                             ///< over the thing classes that the ground truth has
};

/// Average precision of thing instances. Predictions of a class, in order of descending score, each match the unmatched
/// instance of the ground truth with the highest IoU, if that is at least `iou`. The result is the area below the
/// monotone precision-recall curve. Instances below `min_elements` and predictions that match one are ignored. `scores`
/// by predicted instance, 1 if missing; on equal scores the larger instance comes first, then the smaller id.
PrecisionAt ScoreInstances(const SegmentOverlap& overlap, const ClassMap& classes,
                           const std::map<std::uint32_t, float>& scores, double iou, std::int64_t min_elements);

/// Area below the precision-recall curve of ranked predictions, each right or wrong, for `num_truth` instances.
double AreaBelowCurve(const std::vector<bool>& is_right, std::int64_t num_truth);

}  // namespace dhpmap::evaluator
