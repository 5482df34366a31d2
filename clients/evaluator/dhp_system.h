// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

/// Our own pipeline with the configuration as it is.
std::unique_ptr<MappingSystem> MakeDhp(std::string name, const SystemSetup& setup);

}  // namespace dhpmap::evaluator
