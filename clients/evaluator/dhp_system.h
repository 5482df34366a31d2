// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

/// Our pipeline with the given configuration. Its surface is one field if the refinement makes positions exclusive,
/// else the surfaces of the submaps.
std::unique_ptr<MappingSystem> MakeDhp(std::string name, const SystemSetup& setup);

/// The same, always with one field: each place has the object seen there most often. So a map without refinement is not
/// penalised for overlapping surfaces.
std::unique_ptr<MappingSystem> MakeDhpOfOneField(std::string name, const SystemSetup& setup);

/// The map of the ground truth's labels: our pipeline, keeping every object with at least one point, without
/// refinement. Its surface is one field, with the object seen most often at each place.
std::unique_ptr<MappingSystem> MakeTruthMap(SystemSetup setup);

}  // namespace dhpmap::evaluator
