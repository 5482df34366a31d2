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
  std::vector<std::optional<double>> classes;  ///< by evaluated class; none for stuff and absent things
  double mean = 0;                             ///< over the thing classes that the ground truth has
};

/// Average precision of thing instances: the predictions of a class, surest first, each take the unmatched instance of
/// the ground truth with the highest IoU, if that is at least `iou`; the result is the area below the curve of
/// precision (made falling) over recall. Instances below `min_elements` count nowhere, nor do predictions that match
/// one. `scores` by predicted instance, absent = 1; equal scores: the larger first, then the smaller id.
PrecisionAt ScoreInstances(const SegmentOverlap& overlap, const ClassMap& classes,
                           const std::map<std::uint32_t, float>& scores, double iou, std::int64_t min_elements);

/// Area below the precision-recall curve of predictions in order of their rank: right or wrong, out of `num_truth`.
double AreaBelowCurve(const std::vector<bool>& is_right, std::int64_t num_truth);

}  // namespace dhpmap::evaluator
