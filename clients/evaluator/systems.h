// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clients/evaluator/mapping_system.h"
#include "mapping/base/result.h"

namespace dhpmap::evaluator {

/// Every name that MakeSystem knows, in the order of the tables.
std::vector<std::string> SystemNames();

/// What it is, in a few words; empty for an unknown name.
std::string SystemDescription(const std::string& name);

/// `dhp` maps with the setup's configuration as it is; the others switch parts of the refinement off, or are other
/// systems, some of them in two ways, since it is the data that decides which helps them. INVALID_ARGUMENT for an
/// unknown name, listing those there are, and for a configuration out of range.
Result<std::unique_ptr<MappingSystem>> MakeSystem(const std::string& name, SystemSetup setup);

/// OK if MakeSystem knows the name.
Status CheckSystemName(const std::string& name);

}  // namespace dhpmap::evaluator
