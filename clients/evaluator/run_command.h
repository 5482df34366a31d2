// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace CLI {
class App;
}

namespace dhpmap::evaluator {

/// Adds `run`: one data set, chosen systems. `status` receives the result when the command line is parsed.
void AddRunCommand(CLI::App& app, Status& status);

}  // namespace dhpmap::evaluator
