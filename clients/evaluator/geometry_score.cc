// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/geometry_score.h"

#include <algorithm>
#include <vector>

namespace dhpmap::evaluator {
namespace {

double ShareBelow(std::span<const Neighbour> neighbours, double threshold_m) {
  if (neighbours.empty()) return 0;
  const auto num_near = std::count_if(neighbours.begin(), neighbours.end(), [threshold_m](const Neighbour& n) {
    return static_cast<double>(n.distance_m) < threshold_m;
  });
  return static_cast<double>(num_near) / static_cast<double>(neighbours.size());
}

}  // namespace

double GeometryLimits::reach_m() const {
  return std::max({threshold_m, accuracy_truncation_m, completion_truncation_m});
}

double GeometryScore::f_score() const {
  return precision + recall == 0 ? 0.0 : 2 * precision * recall / (precision + recall);
}

double ShareCovered(std::span<const Neighbour> from_truth, std::span<const ElementLabel> truth, double within_m) {
  std::vector<Neighbour> judged;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i].class_index != ClassMap::kNone) judged.push_back(from_truth[i]);
  }
  return ShareBelow(judged, within_m);
}

GeometryScore ScoreGeometry(std::span<const Neighbour> from_predicted, std::span<const Neighbour> from_truth,
                            const GeometryLimits& limits) {
  GeometryScore score;
  double sum_m = 0;
  std::int64_t count = 0;
  for (const Neighbour& n : from_predicted) {
    if (!n.exists() || n.distance_m > limits.accuracy_truncation_m) continue;
    sum_m += n.distance_m;
    ++count;
  }
  // Without predicted samples near the truth, use the worst value.
  score.accuracy_m = count > 0 ? sum_m / static_cast<double>(count) : limits.accuracy_truncation_m;
  sum_m = 0;
  for (const Neighbour& n : from_truth) {
    sum_m +=
        n.exists() ? std::min<double>(n.distance_m, limits.completion_truncation_m) : limits.completion_truncation_m;
  }
  score.completion_m = from_truth.empty() ? 0.0 : sum_m / static_cast<double>(from_truth.size());
  score.precision = ShareBelow(from_predicted, limits.threshold_m);
  score.recall = ShareBelow(from_truth, limits.threshold_m);
  return score;
}

}  // namespace dhpmap::evaluator
