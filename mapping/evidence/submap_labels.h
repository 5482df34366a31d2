// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Class totals, class and instance confidence of a submap from the counts of its voxels (paper II-C, label of a
/// submap). What a voxel that it holds by conclusion has seen is of another: it is no vote for a class of this one. A
/// submap without voxel labels keeps those it has; the unknown submap has none.
void RecomputeSubmapLabels(Submap& submap);

/// Gives voxels of blocks whose labels were dropped the submap's label back: its class and its own instance, counted as
/// often as an average voxel of it was observed. Returns how many blocks got labels.
int RestoreDroppedLabels(Submap& submap);

}  // namespace dhpmap
