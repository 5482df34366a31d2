// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "clients/evaluator/elements.h"
#include "clients/evaluator/nearest_sample.h"

namespace dhpmap::evaluator {

using LabelCounts = std::map<ElementLabel, std::int64_t>;

/// Counts the false surface of a system: its samples whose nearest element of the truth (`from_predicted`) is farther
/// than `d_match_m`, each as `elements_a_sample` elements. `labels` are those of the samples; labels that are not
/// evaluated are ignored.
LabelCounts FalseSurface(std::span<const Neighbour> from_predicted, const std::vector<ElementLabel>& labels,
                         double d_match_m, double elements_a_sample);

}  // namespace dhpmap::evaluator
