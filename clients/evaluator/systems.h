// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clients/evaluator/mapping_system.h"
#include "mapping/base/result.h"

namespace dhpmap::evaluator {

/// All names that MakeSystem accepts, in the order of the tables.
std::vector<std::string> SystemNames();

/// A short description; empty for an unknown name.
std::string SystemDescription(const std::string& name);

/// `dhp` maps with the setup's configuration; other systems switch off parts of the refinement, or are baselines, some
/// of them in two variants, because the better one depends on the data. INVALID_ARGUMENT for an unknown name, with a
/// list of the known ones, and for a configuration out of range.
Result<std::unique_ptr<MappingSystem>> MakeSystem(const std::string& name, SystemSetup setup);

/// OK if MakeSystem accepts the name.
Status CheckSystemName(const std::string& name);

}  // namespace dhpmap::evaluator
