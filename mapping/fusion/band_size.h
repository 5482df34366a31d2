// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "mapping/fusion/integrator.h"
#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// Limit of blocks that one frame may touch: each takes up to 10 kB, new or copied. A camera frame of a room touches
/// hundreds, a LiDAR scan of a street some ten thousand. It also limits the cells of a frame (BundleCell): each touches
/// at least one block and takes memory before any block is touched.
inline constexpr std::size_t kMaxBlocksAFrame = std::size_t{1} << 17;

/// Upper bound of the blocks that IntegrateSegment touches for these segments, which go into different submaps: the
/// blocks around the traversed part of each ray (RayBand). Stops counting at some point above `enough`. Returns the
/// cheap bound of 27 blocks a cell if that is at most `enough`. Exceeds every `enough` for segments that were cut
/// short.
std::size_t CountBandBlocks(std::span<const SegmentBundles> segments, const RayOrigin& origin, double voxel_size_m,
                            double truncation_m, std::size_t enough);

}  // namespace dhpmap
