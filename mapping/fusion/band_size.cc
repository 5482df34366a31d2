// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/band_size.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "mapping/fusion/grazed_columns.h"
#include "mapping/fusion/ray_band.h"

namespace dhpmap {
namespace {

constexpr std::size_t kAround = 27;  // the truncation is at most a block's side

/// The blocks around a cell's own, x fastest.
using Mask = std::bitset<kAround>;

BlockIndex NeighbourOf(BlockIndex center, std::size_t i) {
  const auto n = static_cast<int>(i);
  return {center.x + n % 3 - 1, center.y + n / 3 % 3 - 1, center.z + n / 9 - 1};
}

/// First and last block along one axis, relative to the cell's own block, that contains a voxel between two positions
/// or within `margin_vox` of them.
struct BlockRange {
  int first, last;
  BlockRange(float a_vox, float b_vox, float margin_vox, std::int32_t base, std::int32_t center) {
    const auto block = [&](float vox) {
      return ((base + static_cast<std::int32_t>(std::floor(vox))) >> kBlockSideLog2) - center;
    };
    first = std::clamp(block(std::min(a_vox, b_vox) - margin_vox), -1, 1);
    last = std::clamp(block(std::max(a_vox, b_vox) + margin_vox), -1, 1);
  }
};

Mask BlocksAround(const BundleCell& cell, const SegmentBundles& segment, const RayOrigin& origin, float voxels_per_m,
                  float truncation_m) {
  Mask mask;
  for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
    const Eigen::Vector3f end_m = segment.bundles[b].weighted_sum_m / segment.bundles[b].weight;
    const float range_m = end_m.norm();
    const Eigen::Vector3f direction = end_m / range_m;
    const RayBand band(segment.bundles[b].plane, direction, range_m, truncation_m, 1 / voxels_per_m);
    const Eigen::Vector3f from_vox = origin.offset_vox + direction * (band.from_m * voxels_per_m);
    const Eigen::Vector3f to_vox = origin.offset_vox + direction * (band.to_m * voxels_per_m);
    const float margin_vox =
        GrazedColumns::AreNeeded(segment.bundles[b].plane, direction) ? GrazedColumns::kReach_vox : 0;
    const BlockRange x(from_vox.x(), to_vox.x(), margin_vox, origin.voxel.x, cell.block.x);
    const BlockRange y(from_vox.y(), to_vox.y(), margin_vox, origin.voxel.y, cell.block.y);
    const BlockRange z(from_vox.z(), to_vox.z(), margin_vox, origin.voxel.z, cell.block.z);
    for (int k = z.first; k <= z.last; ++k) {
      for (int j = y.first; j <= y.last; ++j) {
        for (int i = x.first; i <= x.last; ++i) mask.set(static_cast<std::size_t>(i + 1 + 3 * (j + 1) + 9 * (k + 1)));
      }
    }
  }
  return mask;
}

}  // namespace

std::size_t CountBandBlocks(std::span<const SegmentBundles> segments, const RayOrigin& origin, double voxel_size_m,
                            double truncation_m, std::size_t enough) {
  std::size_t num_cells = 0;
  for (const SegmentBundles& segment : segments) {
    if (segment.is_cut_short) return std::numeric_limits<std::size_t>::max();
    num_cells += segment.cells.size();
  }
  if (num_cells * kAround <= enough) return num_cells * kAround;

  const auto voxels_per_m = static_cast<float>(1.0 / voxel_size_m);
  std::size_t total = 0;
  std::unordered_set<BlockIndex, BlockIndexHash> blocks;
  for (const SegmentBundles& segment : segments) {
    blocks.clear();
    for (const BundleCell& cell : segment.cells) {
      const Mask mask = BlocksAround(cell, segment, origin, voxels_per_m, static_cast<float>(truncation_m));
      for (std::size_t i = 0; i < kAround; ++i) {
        if (mask.test(i)) blocks.insert(NeighbourOf(cell.block, i));
      }
      if (total + blocks.size() > enough) return total + blocks.size();
    }
    total += blocks.size();
  }
  return total;
}

}  // namespace dhpmap
