// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

/// Adds instances to the surface of a system that has none: connected parts of each thing class become objects. Two
/// cells of `gap_vox` voxels (of `voxel_size_m`) with surface of one class are connected if they touch, also at
/// corners, as in SplitIntoParts. Ids count from 1, in the order of the mesh. Background and class 0 keep 0.
void NumberConnectedObjects(const LabelSet& label_set, double voxel_size_m, int gap_vox, LabelledSurface& surface);

/// Wraps `system` under another name, with objects by NumberConnectedObjects.
std::unique_ptr<MappingSystem> WithConnectedObjects(std::string name, const SystemSetup& setup,
                                                    std::unique_ptr<MappingSystem> system);

}  // namespace dhpmap::evaluator
