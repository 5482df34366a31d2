// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/surface_crossings.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

#include "mapping/base/index_map.h"
#include "mapping/voxels/shown_mask.h"

namespace dhpmap {
namespace {

/// The step of LinearIndex to the next voxel along an axis, and to the last one of the block.
constexpr std::array<int, 3> kStep = {1, kBlockSide, kBlockSide* kBlockSide};
constexpr std::array<int, 3> kToLast = {kBlockSide - 1, kBlockSide*(kBlockSide - 1),
                                        kBlockSide* kBlockSide*(kBlockSide - 1)};

/// See storage/codec/tsdf_codec.cc.
constexpr double kStepsPerTruncation = 8192, kLeastTruncation_m = 1e-6;

/// Voxels that have another of the block after them along x and along y, in a layer.
constexpr std::uint64_t kBeforeLastX = 0x7F7F7F7F7F7F7F7Fu, kBeforeLastY = 0x00FFFFFFFFFFFFFFu;

/// A block with what its voxels show.
struct ShownBlock {
  BlockEntry block;
  VoxelMask shown, behind;  ///< of these, those behind the surface
};

class CrossingFinder {
 public:
  explicit CrossingFinder(const Submap& submap)
      : voxel_size_m_(submap.info().voxel_size_m),
        steps_per_m_(kStepsPerTruncation / std::max(kLeastTruncation_m, submap.info().truncation_m)) {
    for (const TileEntry& tile : submap.blocks().tiles()) {
      const ScannedTile scanned(*tile.tile);
      for (const BlockEntry& entry : scanned.entries()) Add(entry);
    }
  }

  std::vector<SurfaceCrossing> Run() {
    for (const ShownBlock& from : blocks_) {
      AddWithin(from);
      for (int axis = 0; axis < 3; ++axis) {
        std::array<std::int32_t, 3> at = {from.block.index.x, from.block.index.y, from.block.index.z};
        ++at[static_cast<std::size_t>(axis)];
        const std::uint32_t next = numbers_.Find({at[0], at[1], at[2]});
        if (next != IndexMap<BlockIndex>::kNone) AddBetween(from, blocks_[next], axis);
      }
    }
    return std::move(found_);
  }

 private:
  void Add(const BlockEntry& entry) {
    if (entry.tsdf == nullptr) return;
    const auto least_m = static_cast<float>(-0.5 / steps_per_m_);  // what is not below is rounded to 0
    ShownBlock block{entry, ShownMask(entry),
                     MaskWhere(entry.tsdf->distance_m, [least_m](float d) { return d < least_m; })};
    if (HasNone(block.shown)) return;
    numbers_.Set(entry.index, static_cast<std::uint32_t>(blocks_.size()));
    blocks_.push_back(std::move(block));
  }

  void AddWithin(const ShownBlock& of) {
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t shown = of.shown[z], behind = of.behind[z];
      const int first = static_cast<int>(z * kLayerVoxels);
      AddAll(of, first, shown & shown >> 1 & (behind ^ behind >> 1) & kBeforeLastX, 0);
      AddAll(of, first, shown & shown >> 8 & (behind ^ behind >> 8) & kBeforeLastY, 1);
      if (z + 1 == kBlockSide) continue;
      AddAll(of, first, shown & of.shown[z + 1] & (behind ^ of.behind[z + 1]), 2);
    }
  }
  void AddAll(const ShownBlock& of, int first, std::uint64_t layer, std::size_t axis) {
    for (; layer != 0; layer &= layer - 1) {
      const int linear = first + std::countr_zero(layer);
      AddOne(of, linear, *of.block.tsdf, linear + kStep[axis], static_cast<int>(axis));
    }
  }

  /// From the last voxels of one along an axis to the first of the next.
  void AddBetween(const ShownBlock& from, const ShownBlock& next, int axis) {
    const std::size_t across = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
    for (int i = 0; i < kBlockSide * kBlockSide; ++i) {
      const int first = i % kBlockSide * kStep[across] + i / kBlockSide * kStep[up];
      const int last = first + kToLast[static_cast<std::size_t>(axis)];
      if (!IsIn(from.shown, last) || !IsIn(next.shown, first)) continue;
      if (IsIn(from.behind, last) != IsIn(next.behind, first)) AddOne(from, last, *next.block.tsdf, first, axis);
    }
  }

  void AddOne(const ShownBlock& from, int a, const TsdfBlock& next, int b, int axis) {
    const TsdfBlock& tsdf = *from.block.tsdf;
    const double of_a = Rounded(tsdf.distance_m[a]), of_b = Rounded(next.distance_m[b]);
    Eigen::Vector3d p_m = VoxelCentre(VoxelIn(from.block.index, a), voxel_size_m_);
    p_m[axis] += voxel_size_m_ * of_a / (of_a - of_b);
    found_.push_back({.p_m = p_m,
                      .normal = NormalAt(from, a, axis, of_b - of_a),
                      .weight = std::min(tsdf.weight[a], next.weight[b])});
  }

  /// `along`: the difference to the next voxel along an axis, in whichever block that is.
  [[nodiscard]] Eigen::Vector3d NormalAt(const ShownBlock& block, int linear, int axis, double along) const {
    const auto& distance_m = block.block.tsdf->distance_m;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const int step = kStep[static_cast<std::size_t>(k)], at = linear / step % kBlockSide;
      const bool has_before = at > 0 && IsIn(block.shown, linear - step);
      const bool has_after = at + 1 < kBlockSide && IsIn(block.shown, linear + step);
      const int before = has_before ? linear - step : linear, after = has_after ? linear + step : linear;
      if (before == after) continue;
      gradient[k] = (Rounded(distance_m[after]) - Rounded(distance_m[before])) / (has_before && has_after ? 2 : 1);
    }
    gradient[axis] = along;
    return gradient.normalized();
  }

  /// In the steps to which the store rounds distances: the same before and after a restart.
  [[nodiscard]] double Rounded(float distance_m) const {
    return std::nearbyint(static_cast<double>(distance_m) * steps_per_m_);
  }

  const double voxel_size_m_, steps_per_m_;
  std::vector<ShownBlock> blocks_;
  IndexMap<BlockIndex> numbers_;  ///< in blocks_
  std::vector<SurfaceCrossing> found_;
};

}  // namespace

std::vector<SurfaceCrossing> FindSurfaceCrossings(const Submap& submap) { return CrossingFinder(submap).Run(); }

}  // namespace dhpmap
