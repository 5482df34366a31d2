// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "clients/evaluator/elements.h"
#include "clients/evaluator/nearest_sample.h"

namespace dhpmap::evaluator {

struct GeometryLimits {
  double threshold_m = 0.05;             ///< of the F-score
  double accuracy_truncation_m = 0.5;    ///< predicted samples farther away are ignored for accuracy
  double completion_truncation_m = 2.0;  ///< larger distances count as this
  /// The largest distance that must be known.
  [[nodiscard]] double reach_m() const;
};

/// Distances between two surfaces, over evenly spread samples of both.
struct GeometryScore {
  double accuracy_m = 0;    ///< mean distance of predicted samples to the ground truth
  double completion_m = 0;  ///< mean distance of the ground truth's samples to the prediction
  double precision = 0;     ///< share of predicted samples within the threshold
  double recall = 0;        ///< share of the ground truth's samples within the threshold
  double covered = 0;       ///< see ShareCovered
  [[nodiscard]] double chamfer_l1_m() const { return 0.5 * (accuracy_m + completion_m); }
  [[nodiscard]] double f_score() const;  ///< harmonic mean of precision and recall, 0..1
};

/// The share of judged samples of the ground truth with a predicted surface within `within_m`. Moving objects are not
/// judged, because no surface of them remains.
double ShareCovered(std::span<const Neighbour> from_truth, std::span<const ElementLabel> truth, double within_m);

/// Leaves `covered` unset.
GeometryScore ScoreGeometry(std::span<const Neighbour> from_predicted, std::span<const Neighbour> from_truth,
                            const GeometryLimits& limits);

}  // namespace dhpmap::evaluator
