// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "clients/evaluator/experiment.h"

namespace dhpmap::evaluator {

/// Everything of an experiment: data set, every key of the configuration, thresholds, class map, and per system the
/// scores overall and per class that the ground truth or the prediction has. Units in the names of the keys.
nlohmann::json ToJson(const Experiment& experiment);

}  // namespace dhpmap::evaluator
