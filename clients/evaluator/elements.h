// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/evaluator/class_map.h"
#include "clients/evaluator/nearest_sample.h"
#include "clients/evaluator/surface_samples.h"

namespace dhpmap::evaluator {

/// Label of an element, as an evaluated class.
struct ElementLabel {
  std::int16_t class_index = ClassMap::kNone;
  std::uint32_t instance = 0;  ///< 0 for stuff, whose class is one segment
  constexpr auto operator<=>(const ElementLabel&) const = default;
};

/// The unit that scores count: a sample of the ground truth's surface with its true and predicted label.
struct Element {
  ElementLabel truth;      ///< class kNone: not judged, always ignored
  ElementLabel predicted;  ///< class kNone: missing, or not an evaluated class
};

/// The true labels of the ground truth's samples.
std::vector<ElementLabel> TruthLabels(const SurfaceSamples& truth, const ClassMap& classes);

/// The labels of predictions, one by one: kNone for class 0 and classes that are not evaluated. `use_instances` false:
/// each class is one instance.
std::vector<ElementLabel> LabelsOf(std::span<const std::uint16_t> predicted_classes,
                                   std::span<const std::uint32_t> predicted_instances, const ClassMap& classes,
                                   bool use_instances);

/// The predicted label of each sample of the ground truth, that is, of its nearest predicted sample in `neighbours`;
/// kNone if that is farther than d_match_m or has no label. `use_instances` false: each class is one instance.
std::vector<ElementLabel> PredictedLabels(std::span<const Neighbour> neighbours, const SurfaceSamples& predicted,
                                          const ClassMap& classes, double d_match_m, bool use_instances);

/// Pairs the labels; both must have the same length.
std::vector<Element> Pair(const std::vector<ElementLabel>& truth, const std::vector<ElementLabel>& predicted);

}  // namespace dhpmap::evaluator
