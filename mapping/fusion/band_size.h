// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "mapping/fusion/integrator.h"
#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// Blocks that one frame may touch: each takes up to 10 kB, new or copied. A camera frame of a room touches some
/// hundreds, a LiDAR scan of a street some ten thousand. Nor may it have more cells (BundleCell): each touches a block
/// at least, and with its bundles takes memory before anything is touched.
inline constexpr std::size_t kMaxBlocksAFrame = std::size_t{1} << 17;

/// Upper bound of the blocks that IntegrateSegment touches for these segments, which go into different submaps: the
/// blocks around the part of each ray that is walked (RayBand). Stops counting somewhere above `enough`. Does
/// not look closer than 27 blocks a cell where that is already at most `enough`, so it costs next to nothing then. More
/// than any `enough` for segments that were cut short.
std::size_t CountBandBlocks(std::span<const SegmentBundles> segments, const RayOrigin& origin, double voxel_size_m,
                            double truncation_m, std::size_t enough);

}  // namespace dhpmap
