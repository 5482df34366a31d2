// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/observed_sphere.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

using Eigen::Array3d;
using Eigen::Array3i;

/// Half-open, in voxels.
struct Box {
  Array3i low = Array3i::Constant(std::numeric_limits<std::int32_t>::max());
  Array3i high = Array3i::Constant(std::numeric_limits<std::int32_t>::min());

  [[nodiscard]] bool IsEmpty() const { return (low >= high).any(); }
  [[nodiscard]] bool Contains(const Box& other) const { return (other.low >= low && other.high <= high).all(); }
  [[nodiscard]] bool IsAtRimOf(const Box& other) const { return (low <= other.low || high >= other.high).any(); }
  void Add(const Box& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
};

template <typename Index>
Box Cube(const Index& index, int side) {
  const Array3i low = Array3i(index.x, index.y, index.z) * side;
  return {low, low + side};
}

Box CubeOf(BlockIndex block) { return Cube(block, kBlockSide); }
Box CubeOf(const BlockEntry& entry) { return Cube(entry.index, kBlockSide); }
Box CubeOf(const TileEntry& tile) { return Cube(tile.index, kBlockSide * kTileSide); }

/// Around the observed voxels that an extent says of a tile.
Box BoxOf(TileIndex tile, const TileExtent& extent) {
  if (extent.IsEmpty()) return {};
  const Array3i corner = Array3i(tile.x, tile.y, tile.z) * (kBlockSide * kTileSide);
  return {corner + Array3i(extent.low[0], extent.low[1], extent.low[2]),
          corner + Array3i(extent.high[0], extent.high[1], extent.high[2])};
}

/// Around the observed voxels of a block.
Box BoxOfObserved(const BlockEntry& entry) { return BoxOf(TileOf(entry.index), ExtentOf({&entry, 1})); }

using Tiles = std::vector<const TileEntry*>;

/// Those of which it is not known what of them is observed, and which are in memory. What the others hold is added to
/// `observed`: of one on the disk it is found once.
Tiles AddKnown(const BlockTable& blocks, Box& observed) {
  Tiles unknown;
  for (const TileEntry& tile : blocks.tiles()) {
    if (observed.Contains(CubeOf(tile))) continue;
    if (!tile.tile->KnownExtent() && tile.tile->IsRead()) unknown.push_back(&tile);
    else observed.Add(BoxOf(tile.index, tile.tile->Extent()));
  }
  return unknown;
}

/// Around the blocks of tiles; looks into none.
Box BoxOfAllocated(const Tiles& tiles) {
  Box allocated;
  for (const TileEntry* tile : tiles) {
    if (allocated.Contains(CubeOf(*tile))) continue;
    for (std::uint64_t left = tile->tile->cells(); left != 0; left &= left - 1) {
      allocated.Add(CubeOf(BlockIn(tile->index, std::countr_zero(left))));
    }
  }
  return allocated;
}

/// Of the blocks in memory, first those at the rim of their box: few of the others reach out of what these hold.
Box BoxOfObserved(const BlockTable& blocks) {
  Box observed;
  const Tiles unknown = AddKnown(blocks, observed);
  const Box allocated = BoxOfAllocated(unknown);
  for (const bool is_rim : {true, false}) {
    for (const TileEntry* tile : unknown) {
      if (observed.Contains(CubeOf(*tile)) || (is_rim && !CubeOf(*tile).IsAtRimOf(allocated))) continue;
      for (const BlockEntry& entry : tile->tile->entries()) {
        const Box cube = CubeOf(entry);
        if (!observed.Contains(cube) && (!is_rim || cube.IsAtRimOf(allocated))) observed.Add(BoxOfObserved(entry));
      }
    }
  }
  return observed;
}

/// Squared distance from a point to the farthest corner of a box.
double FarthestSquared(const Box& box, const Array3d& from) {
  const Array3d center = (box.low + box.high).cast<double>() / 2;
  const Array3d half = (box.high - box.low).cast<double>() / 2;
  return ((center - from).abs() + half).square().sum();
}

/// Of a tile, as far as is known without a look at voxels: no observed one reaches farther.
double ReachSquared(const TileEntry& tile, const Array3d& from) {
  if (const auto extent = tile.tile->KnownExtent()) {
    return extent->IsEmpty() ? 0 : FarthestSquared(BoxOf(tile.index, *extent), from);
  }
  double reach = 0;
  for (std::uint64_t left = tile.tile->cells(); left != 0; left &= left - 1) {
    reach = std::max(reach, FarthestSquared(CubeOf(BlockIn(tile.index, std::countr_zero(left))), from));
  }
  return reach;
}

double FarthestObservedSquared(const BlockEntry& entry, const Array3d& from) {
  double farthest = 0;
  for (int linear = 0; entry.tsdf != nullptr && linear < kBlockVoxels; ++linear) {
    if (!entry.tsdf->IsObserved(linear)) continue;
    farthest = std::max(farthest, FarthestSquared(Cube(VoxelIn(entry.index, linear), 1), from));
  }
  return farthest;
}

/// The tile that may reach farthest is looked into first, and in it the block that may: few of the others can still
/// reach farther than its voxels.
double FarthestObservedSquared(const BlockTable& blocks, const Array3d& from) {
  double farthest = 0, most = 0;
  const TileEntry* outermost = nullptr;
  for (const TileEntry& tile : blocks.tiles()) {
    if (FarthestSquared(CubeOf(tile), from) <= most) continue;
    const double reach = ReachSquared(tile, from);
    if (reach > most) most = reach, outermost = &tile;
  }
  const auto look_into = [&](const TileEntry& tile) {
    const ScannedTile scanned(*tile.tile);
    std::vector<std::pair<double, const BlockEntry*>> by_reach;
    by_reach.reserve(scanned.entries().size());
    for (const BlockEntry& entry : scanned.entries())
      by_reach.emplace_back(FarthestSquared(CubeOf(entry), from), &entry);
    std::sort(by_reach.begin(), by_reach.end(), std::greater<>());
    for (const auto& [reach, entry] : by_reach) {
      if (reach <= farthest) return;
      farthest = std::max(farthest, FarthestObservedSquared(*entry, from));
    }
  };
  if (outermost != nullptr) look_into(*outermost);
  for (const TileEntry& tile : blocks.tiles()) {
    if (FarthestSquared(CubeOf(tile), from) > farthest && ReachSquared(tile, from) > farthest) look_into(tile);
  }
  return farthest;
}

KeptExtent::Values FindExtent(const BlockTable& blocks) {
  const Box box = BoxOfObserved(blocks);
  if (box.IsEmpty()) return {0, 0, 0, -1};
  const Array3d center = (box.low + box.high).cast<double>() / 2;
  return {center.x(), center.y(), center.z(), FarthestObservedSquared(blocks, center)};
}

}  // namespace

BoundingSphere SphereOfObserved(const Submap& submap) {
  std::optional<KeptExtent::Values> extent = submap.blocks().extent().Find();
  if (!extent) {
    extent = FindExtent(submap.blocks());
    submap.blocks().extent().Keep(*extent);
  }
  const auto& [x, y, z, squared] = *extent;
  if (squared < 0) return {};
  const double voxel_size_m = submap.info().voxel_size_m;
  return {Eigen::Vector3d(x, y, z) * voxel_size_m, std::sqrt(squared) * voxel_size_m};
}

BoundingSphere SphereOfObservedInMap(const Submap& submap) {
  const BoundingSphere sphere = SphereOfObserved(submap);
  return {submap.info().T_map_submap * sphere.center_m, sphere.radius_m};
}

}  // namespace dhpmap
