// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/evaluator/class_map.h"
#include "clients/evaluator/nearest_sample.h"
#include "clients/evaluator/surface_samples.h"

namespace dhpmap::evaluator {

/// Label of an element, in evaluated classes.
struct ElementLabel {
  std::int16_t class_index = ClassMap::kNone;
  std::uint32_t instance = 0;  ///< 0 for stuff: a class is one segment
  constexpr auto operator<=>(const ElementLabel&) const = default;
};

/// What the scores are counted over: a sample of the ground truth's surface with what it is and what a system says.
struct Element {
  ElementLabel truth;      ///< class kNone: not judged, ignored everywhere
  ElementLabel predicted;  ///< class kNone: missing, or a class that is not evaluated
};

/// The ground truth's labels of its samples.
std::vector<ElementLabel> TruthLabels(const SurfaceSamples& truth, const ClassMap& classes);

/// What a prediction says, place by place: kNone where the class is 0 or not evaluated. `use_instances` false: of each
/// class, all is one instance.
std::vector<ElementLabel> LabelsOf(std::span<const std::uint16_t> predicted_classes,
                                   std::span<const std::uint32_t> predicted_instances, const ClassMap& classes,
                                   bool use_instances);

/// The prediction's label of each sample of the ground truth, whose nearest predicted samples are `neighbours`: that of
/// the neighbour; kNone if it is farther than d_match_m or does not say. `use_instances` false: of each class, all is
/// one instance.
std::vector<ElementLabel> PredictedLabels(std::span<const Neighbour> neighbours, const SurfaceSamples& predicted,
                                          const ClassMap& classes, double d_match_m, bool use_instances);

/// Pairs them up; both of the same length.
std::vector<Element> Pair(const std::vector<ElementLabel>& truth, const std::vector<ElementLabel>& predicted);

}  // namespace dhpmap::evaluator
