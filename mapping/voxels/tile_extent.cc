// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/tile_extent.h"

#include <Eigen/Core>
#include <algorithm>

namespace dhpmap {
namespace {

constexpr int kSide = kTileSide * kBlockSide;
constexpr int kBits = 7;  // for values of 0 to kSide
constexpr std::uint64_t kIsKnown = std::uint64_t{1} << (6 * kBits);

/// A block's position in its tile, in voxels.
std::array<int, 3> CornerOf(BlockIndex block) {
  const int cell = CellOf(block);
  constexpr int kMask = kTileSide - 1;
  return {(cell & kMask) * kBlockSide, ((cell >> kTileSideLog2) & kMask) * kBlockSide,
          (cell >> (2 * kTileSideLog2)) * kBlockSide};
}

/// From the maximum weight of each plane across the axes, one row of voxels at a time: ten times as fast as testing
/// each voxel.
TileExtent ExtentOfBlock(const BlockEntry& entry) {
  constexpr int kRows = kBlockSide * kBlockSide;
  TileExtent extent;
  const Eigen::Map<const Eigen::Array<float, kBlockSide, kRows>> rows(entry.tsdf->weight.data());
  const Eigen::Array<float, 1, kRows> of_row = rows.colwise().maxCoeff();
  const Eigen::Map<const Eigen::Array<float, kBlockSide, kBlockSide>> rows_yz(of_row.data());
  using Planes = Eigen::Array<float, kBlockSide, 1>;
  const std::array<Planes, 3> planes = {rows.rowwise().maxCoeff(), rows_yz.rowwise().maxCoeff(),
                                        rows_yz.colwise().maxCoeff().transpose()};
  const std::array<int, 3> corner = CornerOf(entry.index);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int first = kBlockSide, end = 0;
    for (int i = 0; i < kBlockSide; ++i) {
      if (!(planes[axis][i] >= kMinObservedWeight)) continue;
      first = std::min(first, i);
      end = i + 1;
    }
    if (end == 0) return {};
    extent.low[axis] = static_cast<std::uint8_t>(corner[axis] + first);
    extent.high[axis] = static_cast<std::uint8_t>(corner[axis] + end);
  }
  return extent;
}

bool HoldsAllOf(const TileExtent& extent, BlockIndex block) {
  const std::array<int, 3> corner = CornerOf(block);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (extent.low[axis] > corner[axis] || extent.high[axis] < corner[axis] + kBlockSide) return false;
  }
  return true;
}

}  // namespace

void TileExtent::Add(const TileExtent& other) {
  if (other.IsEmpty()) return;
  if (IsEmpty()) {
    *this = other;
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
  }
}

std::uint64_t TileExtent::Code() const {
  std::uint64_t code = kIsKnown;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    code |= std::uint64_t{low[axis]} << (2 * kBits * axis);
    code |= std::uint64_t{high[axis]} << (2 * kBits * axis + kBits);
  }
  return code;
}

std::optional<TileExtent> TileExtent::FromCode(std::uint64_t code) {
  if ((code & kIsKnown) == 0 || code >= 2 * kIsKnown) return std::nullopt;
  TileExtent extent;
  if (code == kIsKnown) return extent;
  constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent.low[axis] = static_cast<std::uint8_t>((code >> (2 * kBits * axis)) & kMask);
    extent.high[axis] = static_cast<std::uint8_t>((code >> (2 * kBits * axis + kBits)) & kMask);
    if (extent.low[axis] >= extent.high[axis] || extent.high[axis] > kSide) return std::nullopt;
  }
  return extent;
}

TileExtent ExtentOf(std::span<const BlockEntry> blocks) {
  TileExtent extent;
  for (const BlockEntry& entry : blocks) {
    if (entry.tsdf != nullptr && !HoldsAllOf(extent, entry.index)) extent.Add(ExtentOfBlock(entry));
  }
  return extent;
}

}  // namespace dhpmap
