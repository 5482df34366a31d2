// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/elements.h"

#include <cstddef>

namespace dhpmap::evaluator {
namespace {

ElementLabel MakeLabel(std::int16_t class_index, std::uint32_t instance, const ClassMap& classes) {
  if (class_index == ClassMap::kNone) return {};
  const bool is_thing = classes.classes()[static_cast<std::size_t>(class_index)].is_thing;
  return {class_index, is_thing ? instance : 0};
}

}  // namespace

std::vector<ElementLabel> TruthLabels(const SurfaceSamples& truth, const ClassMap& classes) {
  std::vector<ElementLabel> labels(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth.instances[i] == 0) continue;  // the unknown submap
    labels[i] = MakeLabel(classes.OfTruth(truth.classes[i]), truth.instances[i], classes);
  }
  return labels;
}

std::vector<ElementLabel> LabelsOf(std::span<const std::uint16_t> predicted_classes,
                                   std::span<const std::uint32_t> predicted_instances, const ClassMap& classes,
                                   bool use_instances) {
  std::vector<ElementLabel> labels(predicted_classes.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (predicted_classes[i] == 0) continue;
    const std::uint32_t instance = use_instances ? predicted_instances[i] : 1;
    labels[i] = MakeLabel(classes.OfPrediction(predicted_classes[i]), instance, classes);
  }
  return labels;
}

std::vector<ElementLabel> PredictedLabels(std::span<const Neighbour> neighbours, const SurfaceSamples& predicted,
                                          const ClassMap& classes, double d_match_m, bool use_instances) {
  const std::vector<ElementLabel> known = LabelsOf(predicted.classes, predicted.instances, classes, use_instances);
  std::vector<ElementLabel> labels(neighbours.size());
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    if (neighbours[i].exists() && neighbours[i].distance_m <= d_match_m) labels[i] = known[neighbours[i].index];
  }
  return labels;
}

std::vector<Element> Pair(const std::vector<ElementLabel>& truth, const std::vector<ElementLabel>& predicted) {
  std::vector<Element> elements(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) elements[i] = {truth[i], predicted[i]};
  return elements;
}

}  // namespace dhpmap::evaluator
