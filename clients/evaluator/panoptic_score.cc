// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/panoptic_score.h"

namespace dhpmap::evaluator {
namespace {

constexpr double kMatchIou = 0.5;

void Add(const ClassPanoptic& quality, PanopticMean& mean) {
  mean.pq += quality.pq();
  mean.sq += quality.sq();
  mean.rq += quality.rq();
  mean.num_classes += 1;
}

void Divide(PanopticMean& mean) {
  if (mean.num_classes == 0) return;
  mean.pq /= mean.num_classes;
  mean.sq /= mean.num_classes;
  mean.rq /= mean.num_classes;
}

}  // namespace

double ClassPanoptic::rq() const {
  const double denominator = num_matched + 0.5 * num_false + 0.5 * num_missed;
  return denominator == 0 ? 0.0 : num_matched / denominator;
}

PanopticScore ScorePanoptics(const SegmentOverlap& overlap, const ClassMap& classes, std::int64_t min_elements) {
  PanopticScore score;
  score.classes.resize(classes.classes().size());
  const auto of = [&score](const ElementLabel& label) -> ClassPanoptic& {
    return score.classes[static_cast<std::size_t>(label.class_index)];
  };
  std::set<ElementLabel> matched_truth, matched_predicted;
  for (const auto& [pair, count] : overlap.shared) {
    const auto& [truth, predicted] = pair;
    if (truth.class_index != predicted.class_index) continue;
    const double iou = overlap.Iou(truth, predicted);
    if (iou <= kMatchIou) continue;
    of(truth).num_matched += 1;
    of(truth).sum_iou += iou;
    matched_truth.insert(truth);
    matched_predicted.insert(predicted);
    score.matches.insert(pair);
  }
  for (const auto& [truth, count] : overlap.truth) {
    const bool is_matched = matched_truth.contains(truth);
    if (!is_matched && count < min_elements) continue;
    of(truth).is_present = true;
    of(truth).num_missed += is_matched ? 0 : 1;
  }
  for (const auto& [predicted, count] : overlap.predicted) {
    if (count >= min_elements && !matched_predicted.contains(predicted)) of(predicted).num_false += 1;
  }
  for (std::size_t c = 0; c < score.classes.size(); ++c) {
    if (!score.classes[c].is_present) continue;
    Add(score.classes[c], score.all);
    Add(score.classes[c], classes.classes()[c].is_thing ? score.things : score.stuff);
  }
  for (PanopticMean* mean : {&score.all, &score.things, &score.stuff}) Divide(*mean);
  return score;
}

}  // namespace dhpmap::evaluator
