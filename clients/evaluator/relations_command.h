// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace CLI {
class App;
}

namespace dhpmap::evaluator {

/// Adds `relations`: scores the relations on, in and next to of maps of simulated recordings. `status` receives the
/// result when the command line is parsed.
void AddRelationsCommand(CLI::App& app, Status& status);

}  // namespace dhpmap::evaluator
