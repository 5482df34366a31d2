// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

/// Gives the surface of a system without instances some: of each class of things, what lies together is one object.
/// Cells of `gap_vox` voxels (of `voxel_size_m`) that hold surface of one class and touch, corners included, are
/// together: as SplitIntoParts has it. Ids count from 1, in the order of the mesh. Background and class 0 keep 0.
void NumberConnectedObjects(const LabelSet& label_set, double voxel_size_m, int gap_vox, LabelledSurface& surface);

/// `system`, under another name, with objects by NumberConnectedObjects.
std::unique_ptr<MappingSystem> WithConnectedObjects(std::string name, const SystemSetup& setup,
                                                    std::unique_ptr<MappingSystem> system);

}  // namespace dhpmap::evaluator
