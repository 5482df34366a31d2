// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/evaluator/mapping_system.h"
#include "mapping/map/map.h"

namespace dhpmap::evaluator {

/// The surface of a map of submaps, each vertex with its submap's class (the label that the map keeps of an object when
/// those of voxels are dropped) and id; the unknown submap says neither. An instance's score is its class confidence
/// times its instance confidence.
///
/// With label management each position belongs to one submap, so that the submaps on the map's grid are parts of one
/// field: it is meshed as a whole, and there are no gaps along the borders of objects, where a cell's corners belong to
/// several. A vertex has the label of the voxel that it lies in. Otherwise, and for submaps on grids of their own, each
/// submap is meshed by itself.
LabelledSurface SurfaceOf(const Map& map);

}  // namespace dhpmap::evaluator
