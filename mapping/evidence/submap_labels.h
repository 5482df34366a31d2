// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Recomputes class totals, class and instance confidence of a submap from its voxels (paper II-C). Voxels held by
/// conclusion do not vote: their counts are of another instance. A submap without voxel labels keeps its totals; the
/// unknown submap has none.
void RecomputeSubmapLabels(Submap& submap);

/// Restores dropped voxel labels from the submap: its class and own instance, with the average count of its voxels.
/// Returns how many blocks got labels.
int RestoreDroppedLabels(Submap& submap);

}  // namespace dhpmap
