// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

// The systems that the paper compares with (section III, Baselines), implemented anew from their publications. All map
// the same frames with the voxel size, truncation, ranges and weighting of the data set's preset.

/// Panmap (Schmid et al., Panoptic Multi-TSDFs, ICRA 2022): overlapping submaps, a projective integrator.
std::unique_ptr<MappingSystem> MakePanmap(const SystemSetup& setup);

/// The same with segments as predicted, each of which may contain several things.
std::unique_ptr<MappingSystem> MakePanmapOfWholeSegments(SystemSetup setup);

/// Kimera-Semantics (Rosinol et al., ICRA 2020): one TSDF, a Bayesian label for each voxel, no instances.
std::unique_ptr<MappingSystem> MakeKimera(const SystemSetup& setup);

/// The plain yardstick: the TSDF of MakeKimera, and at each voxel the class that was predicted most often.
std::unique_ptr<MappingSystem> MakeVotes(const SystemSetup& setup);

/// MakeVotes, with each connected part of a thing class as an object (see NumberConnectedObjects).
std::unique_ptr<MappingSystem> MakeVotesWithObjects(const SystemSetup& setup);

}  // namespace dhpmap::evaluator
