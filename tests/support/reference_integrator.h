// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "mapping/base/grid.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map_config.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::testing {

struct ReferenceVoxel {
  double distance_m = 0;
  double weight = 0;
  std::int64_t num_observations = 0;
};
using ReferenceMap = std::map<VoxelIndex, ReferenceVoxel>;
using PlaneOfVoxel = std::map<VoxelIndex, TangentPlane>;  ///< by the voxel in which a bundle ends

/// The ray-tracing integration of paper II-C, written to be obviously right and nothing else: ordered maps, double
/// precision, and every voxel of a box around the ray tested for intersection. Distances are those to the planes given.
/// Only for depth images of one segment, anti-grazing on.
void IntegrateSlowly(const PanopticFrame& frame, const MapConfig& config, const PlaneOfVoxel& planes,
                     ReferenceMap& map);

}  // namespace dhpmap::testing
