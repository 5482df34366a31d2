// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"

namespace dhpmap::evaluator {

/// A <table> of HTML: a row a system, in the order of `ranked`, which are of experiment.on_points; the scores as bars,
/// the best of a column bold.
std::string ScoreBars(const Experiment& experiment, const std::vector<const Scores*>& ranked);

}  // namespace dhpmap::evaluator
