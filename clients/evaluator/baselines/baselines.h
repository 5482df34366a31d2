// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

// The systems that the paper compares with (its section III, Baselines), written anew after their publications. All map
// with the voxel size, truncation, ranges and weighting of the data set's preset, on the same frames.

/// Panmap (Schmid et al., Panoptic Multi-TSDFs, ICRA 2022): overlapping submaps, a projective integrator.
std::unique_ptr<MappingSystem> MakePanmap(const SystemSetup& setup);

/// The same with segments as they come, which may show several things.
std::unique_ptr<MappingSystem> MakePanmapOfWholeSegments(SystemSetup setup);

/// Kimera-Semantics (Rosinol et al., ICRA 2020): one TSDF, Bayesian label of each voxel, no instances.
std::unique_ptr<MappingSystem> MakeKimera(const SystemSetup& setup);

/// The same with Kimera's carving of free space: rays clear the surface that they pass. Labels are not written along
/// them, where there is no surface to have one.
std::unique_ptr<MappingSystem> MakeKimeraWithCarving(SystemSetup setup);

/// The plain yardstick: the TSDF of MakeKimera, and at each voxel the class that was predicted most often.
std::unique_ptr<MappingSystem> MakeVotes(const SystemSetup& setup);

/// MakeVotes, and of each class of things what lies together is an object (see NumberConnectedObjects).
std::unique_ptr<MappingSystem> MakeVotesWithObjects(const SystemSetup& setup);

}  // namespace dhpmap::evaluator
