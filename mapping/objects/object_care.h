// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// What becomes of things that frames have shown to be no object of their own.
struct ObjectCareReport {
  int num_merged = 0;     ///< into the thing that they are a part of
  int num_dissolved = 0;  ///< into the unknown submap
};

/// Merges pairs of things that are one object, into the older of them: of one class, that overlap or touch, as frames
/// tell (NotePairs) or as somebody has said; never those that must be two, nor what somebody has edited or locked. At
/// least one pair if there is any, and more until `most_blocks` blocks were moved; the others have to wait for the next
/// time.
int MergePairs(Map& map, std::size_t most_blocks);

/// Dissolves settled things of which nothing, or next to nothing, is left to be seen into the unknown submap, confirmed
/// or not: a few wrong frames made them, and label management has given their surface to the objects whose it is. Next
/// to nothing is little surface, around which others hold most of what frames took for the thing. What is absent,
/// edited or locked stays.
int DissolveRemnants(Map& map);

}  // namespace dhpmap
