// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "clients/evaluator/elements.h"
#include "clients/evaluator/nearest_sample.h"

namespace dhpmap::evaluator {

struct GeometryLimits {
  double threshold_m = 0.05;             ///< of the F-score
  double accuracy_truncation_m = 0.5;    ///< predicted samples farther away do not count for accuracy
  double completion_truncation_m = 2.0;  ///< larger distances count as this much
  /// Distances need not be known beyond this.
  [[nodiscard]] double reach_m() const;
};

/// How near two surfaces are, over evenly spread samples of both, each with its distance to the other surface.
struct GeometryScore {
  double accuracy_m = 0;    ///< mean distance of predicted samples to the ground truth
  double completion_m = 0;  ///< mean distance of the ground truth's samples to the prediction
  double precision = 0;     ///< share of predicted samples nearer than the threshold
  double recall = 0;        ///< share of the ground truth's samples nearer than the threshold
  double covered = 0;       ///< see ShareCovered
  [[nodiscard]] double chamfer_l1_m() const { return 0.5 * (accuracy_m + completion_m); }
  [[nodiscard]] double f_score() const;  ///< harmonic mean of precision and recall, 0..1
};

/// The share of the judged samples of the ground truth that have a surface nearer than `within_m`. What moves is not
/// judged: what has gone has no surface any more.
double ShareCovered(std::span<const Neighbour> from_truth, std::span<const ElementLabel> truth, double within_m);

/// Does not tell what is covered.
GeometryScore ScoreGeometry(std::span<const Neighbour> from_predicted, std::span<const Neighbour> from_truth,
                            const GeometryLimits& limits);

}  // namespace dhpmap::evaluator
