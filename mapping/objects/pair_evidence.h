// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/tracking/overlap_table.h"

namespace dhpmap {

/// Wald's sequential probability ratio test of "one object, which the network splits in a tenth of the frames" against
/// "two objects, which it joins in half of the frames": log-likelihood ratios of a frame, in tenths.
inline constexpr std::int32_t kSeenAsOne = 6;    ///< 10 ln(0.9 / 0.5)
inline constexpr std::int32_t kSeenApart = -16;  ///< 10 ln(0.1 / 0.5)
/// Threshold for one object: wrong in fewer than one of 400 cases.
inline constexpr std::int32_t kIsOne = 60;
/// Lower bound, so that recent frames can outweigh old ones.
inline constexpr std::int32_t kLeastEvidence = -120;

/// Updates the evidence of pairs of things of one class whose spheres intersect. The segment that holds most of the
/// points on a thing shows it, with all its parts. Two things shown by one segment count as one, by two segments as
/// two; if one of them is not shown, the frame is no evidence. Ignores persistent ids, which need no evidence, and
/// locked things.
void NotePairs(const std::vector<SegmentBundles>& segments, const OverlapTable& overlaps, Map& map);

}  // namespace dhpmap
