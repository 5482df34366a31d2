// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/tracking/overlap_table.h"

namespace dhpmap {

/// Wald's sequential test of "one object, of which a network makes two in a tenth of the frames" against "two objects,
/// which it takes for one in half of them": logarithms of how much likelier a frame is if they are one, in tenths.
inline constexpr std::int32_t kSeenAsOne = 6;    ///< 10 ln(0.9 / 0.5)
inline constexpr std::int32_t kSeenApart = -16;  ///< 10 ln(0.1 / 0.5)
/// From here on they are one: wrong in less than one of 400.
inline constexpr std::int32_t kIsOne = 60;
/// What was seen long ago is outweighed by as many frames of late.
inline constexpr std::int32_t kLeastEvidence = -120;

/// Notes what a frame says of pairs of things of one class whose spheres meet. What most points on a thing belong to
/// is the segment that shows it, all its parts together. Two things in one segment were seen as one, in two segments
/// apart; if one of them is not shown by a segment the frame says nothing. Does nothing for persistent ids, which need
/// no telling, nor for what is locked.
void NotePairs(const std::vector<SegmentBundles>& segments, const OverlapTable& overlaps, Map& map);

}  // namespace dhpmap
