// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/fusion/voxel_journal.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"
#include "mapping/tracking/tracker.h"

namespace dhpmap {

/// Integrates each segment of a frame into its assigned submap by ray tracing (paper Fig. 2 B, II-C). Submaps are
/// independent, so the result is bit-identical for any number of threads. Of locked submaps only the last-seen time is
/// updated, and voxels in ignored regions are not written. `segments` are on the map's grid, with one assignment each.
/// Blocks that only a Map::ForkInPlace shares are written in place, and what is overwritten is noted in `journal`,
/// which must be empty. Returns the number of voxel updates. Throws Stopped soon after a `stop` request, with part of
/// the frame fused.
std::int64_t FuseFrame(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                       std::span<const Assignment> assignments, Map& map, ThreadPool& pool, FrameJournal& journal,
                       const std::stop_token& stop = {});

}  // namespace dhpmap
