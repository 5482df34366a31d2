// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

/// Our own pipeline with the configuration as it is. Its surface is one field if the refinement makes positions
/// exclusive, else that of each submap.
std::unique_ptr<MappingSystem> MakeDhp(std::string name, const SystemSetup& setup);

/// The same with one field whatever the refinement: each place with the object that was seen there most often, so that
/// what is not refined is not held to surfaces that overlap.
std::unique_ptr<MappingSystem> MakeDhpOfOneField(std::string name, const SystemSetup& setup);

/// What the ground truth's labels say: our pipeline that keeps every object that has a single point and refines
/// nothing; its surface is one field, each place with the object that was seen there most often.
std::unique_ptr<MappingSystem> MakeTruthMap(SystemSetup setup);

}  // namespace dhpmap::evaluator
