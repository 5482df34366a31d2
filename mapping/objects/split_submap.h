// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Whether the voxel with this centre, in the object's own frame, goes to the new object.
using VoxelChoice = std::function<bool(const Eigen::Vector3d& p_submap_m)>;

// Both functions move voxels of an object, with labels and gone counts, to new objects: no observation is lost, and
// each voxel has one owner. A new object copies the row, except display name and track id. Observation counts are
// divided by the labels of the voxels, or without labels by the number of voxels. The pair gets the verdict of two
// objects (ObjectPairs), so that it is not merged again. Counts of the old object in voxels of others do not change.
// Linear in the blocks of the object.

/// Returns the new object; nothing, without any change, unless both sides have voxels.
std::optional<SubmapId> SplitSubmap(SubmapId id, const VoxelChoice& goes, Map& map);

/// Makes an object of each connected part (26-neighbourhood) of observed voxels with at least `least_voxels`, at most
/// `most_parts`, largest first. The largest keeps the id and all smaller parts. Voxels with only labels, and
/// contradicted ones, stay. Returns the new objects, largest first.
std::vector<SubmapId> SplitIntoConnectedParts(SubmapId id, std::size_t least_voxels, std::size_t most_parts, Map& map);

/// Makes a part of any kind a thing of a fixed class; inactive, as frames may not show it again.
void MakeThingOfClass(ClassId class_id, Submap& part);

}  // namespace dhpmap
