// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/observed_sphere.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

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

/// Around the observed voxels of a block. By the greatest weight of each plane across the axes, a row of voxels at a
/// time: ten times as fast as to look at each voxel, of which a wall has a hundred thousand at its rim.
Box BoxOfObserved(const BlockEntry& entry) {
  constexpr int kRows = kBlockSide * kBlockSide;
  Box box;
  if (entry.tsdf == nullptr) return box;
  const Eigen::Map<const Eigen::Array<float, kBlockSide, kRows>> rows(entry.tsdf->weight.data());
  const Eigen::Array<float, 1, kRows> of_row = rows.colwise().maxCoeff();
  const Eigen::Map<const Eigen::Array<float, kBlockSide, kBlockSide>> rows_yz(of_row.data());
  using Planes = Eigen::Array<float, kBlockSide, 1>;
  const std::array<Planes, 3> planes = {rows.rowwise().maxCoeff(), rows_yz.rowwise().maxCoeff(),
                                        rows_yz.colwise().maxCoeff().transpose()};
  const Box cube = CubeOf(entry);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kBlockSide; ++i) {
      if (!(planes[axis][i] >= kMinObservedWeight)) continue;
      box.low[axis] = std::min(box.low[axis], cube.low[axis] + i);
      box.high[axis] = std::max(box.high[axis], cube.low[axis] + i + 1);
    }
  }
  return box;
}

/// Visits the blocks of all tiles that are not `left_out`, of which a large submap has a few hundred.
template <typename IsLeftOut, typename Visitor>
void ForEachBlock(const BlockTable& blocks, IsLeftOut&& left_out, Visitor&& visit) {
  for (const TileEntry& tile : blocks.tiles()) {
    if (left_out(CubeOf(tile))) continue;
    for (const BlockEntry& entry : tile.tile->entries()) visit(entry);
  }
}

/// Visits only where they are, and reads none.
template <typename IsLeftOut, typename Visitor>
void ForEachIndex(const BlockTable& blocks, IsLeftOut&& left_out, Visitor&& visit) {
  for (const TileEntry& tile : blocks.tiles()) {
    if (left_out(CubeOf(tile))) continue;
    for (std::uint64_t left = tile.tile->cells(); left != 0; left &= left - 1) {
      visit(BlockIn(tile.index, std::countr_zero(left)));
    }
  }
}

/// Of the blocks, first those at the rim of their box: few of the others reach out of what these hold.
Box BoxOfObserved(const BlockTable& blocks) {
  Box allocated, observed;
  ForEachIndex(
      blocks, [&](const Box& tile) { return allocated.Contains(tile); },
      [&](BlockIndex block) { allocated.Add(CubeOf(block)); });
  ForEachBlock(
      blocks, [&](const Box& tile) { return !tile.IsAtRimOf(allocated); },
      [&](const BlockEntry& entry) {
        if (CubeOf(entry).IsAtRimOf(allocated)) observed.Add(BoxOfObserved(entry));
      });
  ForEachBlock(
      blocks, [&](const Box& tile) { return observed.Contains(tile); },
      [&](const BlockEntry& entry) {
        if (!observed.Contains(CubeOf(entry))) observed.Add(BoxOfObserved(entry));
      });
  return observed;
}

/// Squared distance from a point to the farthest corner of a box.
double FarthestSquared(const Box& box, const Array3d& from) {
  const Array3d center = (box.low + box.high).cast<double>() / 2;
  const Array3d half = (box.high - box.low).cast<double>() / 2;
  return ((center - from).abs() + half).square().sum();
}

/// The block that reaches farthest is looked into first: few of the others can still reach farther than its voxels.
double FarthestObservedSquared(const BlockTable& blocks, const Array3d& from) {
  double farthest = 0;
  const auto look_into = [&](const BlockEntry& entry) {
    if (entry.tsdf == nullptr) return;
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (!entry.tsdf->IsObserved(linear)) continue;
      farthest = std::max(farthest, FarthestSquared(Cube(VoxelIn(entry.index, linear), 1), from));
    }
  };
  double reach = 0;
  std::optional<BlockIndex> outermost;
  ForEachIndex(
      blocks, [&](const Box& tile) { return FarthestSquared(tile, from) <= reach; },
      [&](BlockIndex block) {
        const double its = FarthestSquared(CubeOf(block), from);
        if (its > reach) reach = its, outermost = block;
      });
  if (outermost) look_into(*blocks.Find(*outermost));
  ForEachBlock(
      blocks, [&](const Box& tile) { return FarthestSquared(tile, from) <= farthest; },
      [&](const BlockEntry& entry) {
        if (FarthestSquared(CubeOf(entry), from) > farthest) look_into(entry);
      });
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
