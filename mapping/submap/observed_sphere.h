// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/submap/bounding_sphere.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// The sphere around the observed voxels of a submap, in its frame (paper II-A): centre of their box, radius to the
/// farthest corner of a voxel. Empty if none is observed. Submap::bounding_sphere(), around whole blocks, is cheaper
/// and wider by up to a block's diagonal. Visits each tile and the few blocks at the rim; cached for all copies until
/// one is written to.
BoundingSphere SphereOfObserved(const Submap& submap);
/// The same in the map frame.
BoundingSphere SphereOfObservedInMap(const Submap& submap);

}  // namespace dhpmap
