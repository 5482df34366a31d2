// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// Cleanup of things that turned out to be no objects of their own.
struct ObjectCareReport {
  int num_merged = 0;     ///< into the thing that they belong to
  int num_dissolved = 0;  ///< into the unknown submap
};

/// Merges pairs of things that are one object into the older of the two: same class, overlapping or touching, by
/// evidence of frames (NotePairs) or by verdict. Never pairs with the opposite verdict, nor edited or locked things.
/// Merges at least one pair if there is any, and more until `most_blocks` blocks have moved; the rest wait for the next
/// call.
int MergePairs(Map& map, std::size_t most_blocks);

/// Dissolves inactive objects whose voxels mostly belong to others into the unknown submap, confirmed or not: a few
/// wrong frames created them, and label management has since assigned their surface. Such an object has no surface
/// left, or little surface surrounded by voxels that others hold although frames labelled them as this thing. Absent,
/// edited and locked things stay.
int DissolveRemnants(Map& map);

}  // namespace dhpmap
