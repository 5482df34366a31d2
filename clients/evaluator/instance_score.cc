// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/instance_score.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace dhpmap::evaluator {
namespace {

struct Candidate {
  ElementLabel label;
  float score = 1;
  std::int64_t num_elements = 0;
};

std::vector<Candidate> Ranked(const SegmentOverlap& overlap, std::int16_t class_index,
                              const std::map<std::uint32_t, float>& scores, std::int64_t min_elements) {
  std::vector<Candidate> ranked;
  for (const auto& [label, count] : overlap.predicted) {
    if (label.class_index != class_index || count < min_elements) continue;
    const auto score = scores.find(label.instance);
    ranked.push_back({label, score == scores.end() ? 1.0f : score->second, count});
  }
  std::sort(ranked.begin(), ranked.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(-a.score, -a.num_elements, a.label.instance) <
           std::tuple(-b.score, -b.num_elements, b.label.instance);
  });
  return ranked;
}

double ScoreClass(const SegmentOverlap& overlap, const std::vector<Candidate>& ranked,
                  const std::vector<ElementLabel>& truth, const std::set<ElementLabel>& too_small, double min_iou) {
  std::set<ElementLabel> free(truth.begin(), truth.end());
  std::vector<bool> is_right;
  for (const Candidate& candidate : ranked) {
    ElementLabel best;
    double best_iou = 0;
    for (const ElementLabel& label : free) {
      const double iou = overlap.Iou(label, candidate.label);
      if (iou > best_iou) best = label, best_iou = iou;
    }
    const bool is_match = best_iou >= min_iou;
    if (is_match) free.erase(best);
    const bool is_ignored = !is_match && std::any_of(too_small.begin(), too_small.end(), [&](const auto& label) {
      return overlap.Iou(label, candidate.label) >= min_iou;
    });
    if (!is_ignored) is_right.push_back(is_match);
  }
  return AreaBelowCurve(is_right, static_cast<std::int64_t>(truth.size()));
}

}  // namespace

double AreaBelowCurve(const std::vector<bool>& is_right, std::int64_t num_truth) {
  if (num_truth == 0) return 0;
  std::vector<double> precision(is_right.size());
  std::int64_t num_right = 0;
  for (std::size_t i = 0; i < is_right.size(); ++i) {
    num_right += is_right[i] ? 1 : 0;
    precision[i] = static_cast<double>(num_right) / static_cast<double>(i + 1);
  }
  double area = 0, best_from_here = 0;
  for (std::size_t i = is_right.size(); i-- > 0;) {
    best_from_here = std::max(best_from_here, precision[i]);
    if (is_right[i]) area += best_from_here / static_cast<double>(num_truth);
  }
  return area;
}

PrecisionAt ScoreInstances(const SegmentOverlap& overlap, const ClassMap& classes,
                           const std::map<std::uint32_t, float>& scores, double iou, std::int64_t min_elements) {
  PrecisionAt result;
  result.iou = iou;
  result.classes.resize(classes.classes().size());
  int num_present = 0;
  for (std::size_t c = 0; c < classes.classes().size(); ++c) {
    if (!classes.classes()[c].is_thing) continue;
    std::vector<ElementLabel> truth;
    std::set<ElementLabel> too_small;
    for (const auto& [label, count] : overlap.truth) {
      if (label.class_index != static_cast<std::int16_t>(c)) continue;
      if (count < min_elements) too_small.insert(label);
      else truth.push_back(label);
    }
    if (truth.empty()) continue;
    const auto ranked = Ranked(overlap, static_cast<std::int16_t>(c), scores, min_elements);
    result.classes[c] = ScoreClass(overlap, ranked, truth, too_small, iou);
    result.mean += *result.classes[c];
    ++num_present;
  }
  if (num_present > 0) result.mean /= num_present;
  return result;
}

}  // namespace dhpmap::evaluator
