// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/observed_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

Box CubeOf(const BlockEntry& entry) { return Cube(entry.index, kBlockSide); }
Box CubeOf(const TileEntry& tile) { return Cube(tile.index, kBlockSide * kTileSide); }

template <typename Visitor>
void ForEachObserved(const BlockEntry& entry, Visitor&& visit) {
  if (entry.tsdf == nullptr) return;
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (entry.tsdf->IsObserved(linear)) visit(Cube(VoxelIn(entry.index, linear), 1));
  }
}

/// Of the blocks, first those at the rim of their box: few of the others reach out of what these hold.
Box BoxOfObserved(const BlockTable& blocks) {
  Box allocated, observed;
  for (const BlockEntry& entry : blocks.entries()) allocated.Add(CubeOf(entry));
  const auto add = [&observed](const Box& voxel) { observed.Add(voxel); };
  for (const BlockEntry& entry : blocks.entries()) {
    if (CubeOf(entry).IsAtRimOf(allocated)) ForEachObserved(entry, add);
  }
  for (const TileEntry& tile : blocks.tiles()) {
    if (observed.Contains(CubeOf(tile))) continue;
    for (const BlockEntry& entry : tile.tile->entries()) {
      if (!observed.Contains(CubeOf(entry))) ForEachObserved(entry, add);
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

/// The block that reaches farthest is looked into first: few of the others can still reach farther than its voxels.
double FarthestObservedSquared(const BlockTable& blocks, const Array3d& from) {
  double farthest = 0;
  const auto look_into = [&](const BlockEntry& entry) {
    ForEachObserved(entry, [&](const Box& voxel) { farthest = std::max(farthest, FarthestSquared(voxel, from)); });
  };
  const auto entries = blocks.entries();
  look_into(*std::max_element(entries.begin(), entries.end(), [&](const BlockEntry& a, const BlockEntry& b) {
    return FarthestSquared(CubeOf(a), from) < FarthestSquared(CubeOf(b), from);
  }));
  for (const TileEntry& tile : blocks.tiles()) {
    if (FarthestSquared(CubeOf(tile), from) <= farthest) continue;
    for (const BlockEntry& entry : tile.tile->entries()) {
      if (FarthestSquared(CubeOf(entry), from) > farthest) look_into(entry);
    }
  }
  return farthest;
}

}  // namespace

BoundingSphere SphereOfObserved(const Submap& submap) {
  const Box box = BoxOfObserved(submap.blocks());
  if (box.IsEmpty()) return {};
  const Array3d center = (box.low + box.high).cast<double>() / 2;
  const double voxel_size_m = submap.info().voxel_size_m;
  return {center.matrix() * voxel_size_m, std::sqrt(FarthestObservedSquared(submap.blocks(), center)) * voxel_size_m};
}

BoundingSphere SphereOfObservedInMap(const Submap& submap) {
  const BoundingSphere sphere = SphereOfObserved(submap);
  return {submap.info().T_map_submap * sphere.center_m, sphere.radius_m};
}

}  // namespace dhpmap
