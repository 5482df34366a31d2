// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"

namespace dhpmap::evaluator {

/// An HTML <table>: a row for each system in the order of `ranked`, which are elements of experiment.on_points; scores
/// as bars, with the best of a column in bold.
std::string ScoreBars(const Experiment& experiment, const std::vector<const Scores*>& ranked);

}  // namespace dhpmap::evaluator
