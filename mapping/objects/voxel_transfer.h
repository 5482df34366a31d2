// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <map>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Voxels of a submap, by block.
using VoxelSet = std::map<BlockIndex, std::bitset<kBlockVoxels>>;

/// Whether anything is known of the voxel.
bool HasVoxel(const BlockEntry& entry, int linear);

/// Takes voxels away; blocks of which nothing is left go. Geometry, labels and counts of what was looked through.
void EraseVoxels(const VoxelSet& voxels, Submap& from);
/// Gives voxels to another submap, which has nothing at these. Whole blocks change hands without being copied.
void MoveVoxels(const VoxelSet& voxels, Submap& from, Submap& to);

}  // namespace dhpmap
