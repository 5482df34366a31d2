// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "clients/evaluator/mapping_system.h"

namespace dhpmap::evaluator {

// The systems that the paper compares with (its section III, Baselines), written anew after their publications. All map
// with the voxel size, truncation, ranges and weighting of the data set's preset, on the same frames.

/// Panmap (Schmid et al., Panoptic Multi-TSDFs, ICRA 2022): overlapping submaps, a projective integrator.
std::unique_ptr<MappingSystem> MakePanmap(const SystemSetup& setup);

/// Kimera-Semantics (Rosinol et al., ICRA 2020): one TSDF, Bayesian label of each voxel, no instances.
std::unique_ptr<MappingSystem> MakeKimera(const SystemSetup& setup);

/// The plain yardstick: the TSDF of MakeKimera, and at each voxel the class that was predicted most often.
std::unique_ptr<MappingSystem> MakeVotes(const SystemSetup& setup);

}  // namespace dhpmap::evaluator
