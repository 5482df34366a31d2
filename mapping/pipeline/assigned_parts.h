// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "mapping/fusion/segment_bundles.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The frame as a submap with a grid of its own is to take it: points of a segment of which a part was assigned to it
/// and other parts were not (SplitIntoParts, Tracker::CutAtSplits) are of no segment where they end in one of those
/// other parts. `segments` are the parts of the frame on the map's grid of `voxel_size_m`; `own`, ascending, which of
/// them are the submap's. Nothing if it has all parts of its segments. Pure, thread-safe; time is linear in points.
std::optional<PanopticFrame> WithoutPartsOfOthers(const PanopticFrame& frame,
                                                  const std::vector<SegmentBundles>& segments,
                                                  std::span<const std::size_t> own, double voxel_size_m);

}  // namespace dhpmap
