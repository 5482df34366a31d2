// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/semantic_score.h"

namespace dhpmap::evaluator {

double ClassCounts::iou() const {
  const std::int64_t num_either = num_truth + num_predicted - num_right;
  return num_either == 0 ? 0.0 : static_cast<double>(num_right) / static_cast<double>(num_either);
}

double MeanIou(std::span<const ClassCounts> classes) {
  int num_present = 0;
  double sum = 0;
  for (const ClassCounts& counts : classes) {
    if (counts.num_truth == 0) continue;
    ++num_present;
    sum += counts.iou();
  }
  return num_present == 0 ? 0.0 : sum / num_present;
}

SemanticScore ScoreSemantics(std::span<const Element> elements, std::size_t num_classes) {
  SemanticScore score;
  score.classes.resize(num_classes);
  std::int64_t num_right = 0;
  for (const Element& element : elements) {
    const std::int16_t truth = element.truth.class_index, predicted = element.predicted.class_index;
    if (truth == ClassMap::kNone) continue;
    ++score.num_elements;
    ++score.classes[static_cast<std::size_t>(truth)].num_truth;
    if (predicted == ClassMap::kNone) continue;
    ++score.num_answered;
    ++score.classes[static_cast<std::size_t>(predicted)].num_predicted;
    if (predicted != truth) continue;
    ++num_right;
    ++score.classes[static_cast<std::size_t>(truth)].num_right;
  }
  score.mean_iou = MeanIou(score.classes);
  if (score.num_elements > 0) {
    score.accuracy = static_cast<double>(num_right) / static_cast<double>(score.num_elements);
  }
  return score;
}

}  // namespace dhpmap::evaluator
