// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace CLI {
class App;
}

namespace dhpmap::evaluator {

/// Adds `paper`: the paper's tables over several data sets. `status` receives the result when the command line is
/// parsed.
void AddPaperCommand(CLI::App& app, Status& status);

}  // namespace dhpmap::evaluator
