// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace CLI {
class App;
}

namespace dhpmap::evaluator {

/// Adds `relations`: what maps of simulated recordings tell of what is on, in or next to what. `status` receives the
/// outcome when the command line is parsed.
void AddRelationsCommand(CLI::App& app, Status& status);

}  // namespace dhpmap::evaluator
