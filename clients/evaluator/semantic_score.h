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
  std::int64_t num_predicted = 0;  ///< elements that are said to be of it
  std::int64_t num_right = 0;      ///< both
  /// Intersection over union; 0 where the class does not occur.
  [[nodiscard]] double iou() const;
};

/// Class labels (mIoU, accuracy). Elements whose truth is not judged count nowhere; a missing prediction is wrong.
struct SemanticScore {
  std::vector<ClassCounts> classes;  ///< by evaluated class
  std::int64_t num_elements = 0;     ///< judged
  std::int64_t num_answered = 0;     ///< of these, with a prediction of an evaluated class
  double mean_iou = 0;               ///< over the classes that the ground truth has
  double accuracy = 0;               ///< share of the judged elements with the right class
};

/// Mean of the classes' IoU over those that the ground truth has.
double MeanIou(std::span<const ClassCounts> classes);

SemanticScore ScoreSemantics(std::span<const Element> elements, std::size_t num_classes);

}  // namespace dhpmap::evaluator
