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

/// What a system says of surfaces that are not there: of its samples, `labels`, those whose nearest element of the
/// truth (`from_predicted`) is farther than `d_match_m`, each for so many elements. Labels that are not evaluated are
/// left out.
LabelCounts FalseSurface(std::span<const Neighbour> from_predicted, const std::vector<ElementLabel>& labels,
                         double d_match_m, double elements_a_sample);

}  // namespace dhpmap::evaluator
