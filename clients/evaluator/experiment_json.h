// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "clients/evaluator/experiment.h"

namespace dhpmap::evaluator {

/// An experiment: data set, all configuration keys, thresholds, class map, and for each system the overall scores and
/// those of each class that the ground truth or the prediction has. Keys contain units.
nlohmann::json ToJson(const Experiment& experiment);

}  // namespace dhpmap::evaluator
