// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"
#include "mapping/tracking/tracker.h"

namespace dhpmap {

/// Integrates each segment of a frame into the submap it was assigned to, by ray tracing (paper Fig. 2 B, II-C), and
/// clears free space if the config says so. Submaps are independent of each other: the result has the same bits for any
/// number of threads. What is locked is only noted as seen, and voxels that the map keeps clear are
/// not written. `segments` are on the map's grid, with one assignment each. Returns the number of voxel updates.
/// Throws Stopped soon after `stop` is requested, with a part done.
std::int64_t FuseFrame(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                       std::span<const Assignment> assignments, Map& map, ThreadPool& pool,
                       const std::stop_token& stop = {});

}  // namespace dhpmap
