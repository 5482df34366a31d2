// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/evaluator/mapping_system.h"
#include "mapping/map/map.h"

namespace dhpmap::evaluator {

/// Our own pipeline with the configuration as it is.
std::unique_ptr<MappingSystem> MakeDhp(std::string name, const SystemSetup& setup);

/// Surfaces of all submaps; things and stuff with their labels, the unknown submap without. An instance's score is its
/// class confidence times its instance confidence.
LabelledSurface SurfaceOf(const Map& map);

}  // namespace dhpmap::evaluator
