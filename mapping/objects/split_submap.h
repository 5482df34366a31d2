// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Whether the voxel with its centre there, in the object's own frame, goes to the new object.
using VoxelChoice = std::function<bool(const Eigen::Vector3d& p_submap_m)>;

// Both take voxels, with their labels and counts of what was looked through, from an object and make other objects of
// them: nothing observed is lost, and each voxel belongs to one. A new object has the old one's row, but no display
// name and no track id. Which of their observations is whose follows from the labels of the voxels; of a map without
// those, from the shares of voxels. The pair is noted as two for ever (ObjectPairs), so that it is not merged again.
// What other objects' voxels have seen of the old one stays so. Cost: the blocks of the object.

/// Returns the new object; nothing, and nothing has changed, unless there are voxels of both.
std::optional<SubmapId> SplitSubmap(SubmapId id, const VoxelChoice& goes, Map& map);

/// Makes an object of each connected part of observed voxels, corners included, that has at least `least_voxels`, but
/// of `most_parts` at most, largest first. The largest keeps the id, and what is left of the rest. Voxels of labels
/// alone and contradicted ones stay. Returns the new objects, largest first.
std::vector<SubmapId> SplitIntoConnectedParts(SubmapId id, std::size_t least_voxels, std::size_t most_parts, Map& map);

/// Makes a part of whatever kind a thing of a class, against later votes: settled, as frames may not show it again.
void MakeThingOfClass(ClassId class_id, Submap& part);

}  // namespace dhpmap
