// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <map>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Voxels of a submap, by block.
using VoxelSet = std::map<BlockIndex, std::bitset<kBlockVoxels>>;

/// Whether the voxel has any data.
bool HasVoxel(const BlockEntry& entry, int linear);

/// Removes geometry, labels and gone counts of voxels, and blocks without voxels left.
void EraseVoxels(const VoxelSet& voxels, Submap& from);
/// Moves voxels to another submap, which must have no data there. Whole blocks are moved without a copy.
void MoveVoxels(const VoxelSet& voxels, Submap& from, Submap& to);

}  // namespace dhpmap
