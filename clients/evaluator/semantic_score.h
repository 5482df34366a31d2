// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/evaluator/elements.h"

namespace dhpmap::evaluator {

/// Counts of one class over the judged elements.
struct ClassCounts {
  std::int64_t num_truth = 0;      ///< elements of the class
  std::int64_t num_predicted = 0;  ///< elements predicted as the class
  std::int64_t num_right = 0;      ///< both
  /// Intersection over union; 0 if the class does not occur.
  [[nodiscard]] double iou() const;
};

/// Class label scores (mIoU, accuracy). Elements whose truth is not judged are ignored; a missing prediction is wrong.
struct SemanticScore {
  std::vector<ClassCounts> classes;  ///< by evaluated class
  std::int64_t num_elements = 0;     ///< judged
  std::int64_t num_answered = 0;     ///< of the judged, with a prediction of an evaluated class
  double mean_iou = 0;               ///< over the classes of the ground truth
  double accuracy = 0;               ///< share of the judged elements with the right class
};

/// Mean IoU over the classes of the ground truth.
double MeanIou(std::span<const ClassCounts> classes);

SemanticScore ScoreSemantics(std::span<const Element> elements, std::size_t num_classes);

}  // namespace dhpmap::evaluator
