// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// Whether some voxels of the map are left on the disk (see TilePage).
bool HasTilesOnDisk(const Map& map);

/// Reads the tiles in which a frame ends, or may write about its ends, of all submaps on the map's grid that have them
/// on the disk: several at a time, where the stages of the frame would read one after the other. `segments` are on the
/// map's grid. Changes nothing that can be seen. Throws StatusError.
void ReadTilesAhead(const std::vector<SegmentBundles>& segments, const Map& map, ThreadPool& pool);

}  // namespace dhpmap
