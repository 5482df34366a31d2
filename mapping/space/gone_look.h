// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "mapping/map/block_table.h"
#include "mapping/space/cell.h"
#include "mapping/space/grid_origin.h"

namespace dhpmap {

/// The voxels of a block that a look contradicts.
struct ContradictedBlock {
  BlockIndex index;
  VoxelMask voxels{};
};

/// Looks at one tile of a submap for surfaces that the view looks through.
///
/// A voxel says that there is a surface within its distance. So it is contradicted if every pixel that a ball of that
/// radius, and half a voxel more, may cover sees farther than the ball and the truncation: as long as the surface is
/// there, either it or something before it is seen in one of these pixels. `View` is CameraView or LidarView.
template <typename View>
class GoneLook {
 public:
  /// `truncation_m`: of the submap; what is farther from its surface says nothing of one.
  GoneLook(const View& view, const GridOrigin& origin, const Viewpoint& from, double voxel_size_m, double truncation_m,
           std::vector<ContradictedBlock>& found)
      : view_(view),
        origin_(origin),
        from_(from),
        voxels_per_m_(static_cast<float>(1 / voxel_size_m)),
        // What carving leaves is no surface.
        most_m_(static_cast<float>(0.999 * truncation_m)),
        found_(found) {}

  void Look(const BlockTile& tile) {
    CellBatch batch;
    batch.size = CellSize::kBlock;
    std::array<const BlockEntry*, kLanes> entries{};
    std::size_t count = 0;
    const auto flush = [&] {
      CellSights sights;
      view_.Classify(batch, sights);
      for (std::size_t i = 0; i < count; ++i) {
        if (sights[i] != CellSight::kHidden) LookAtBlock(*entries[i], batch.x[i], batch.y[i], batch.z[i]);
      }
      count = 0;
    };
    for (const BlockEntry& entry : tile.entries()) {
      if (entry.tsdf == nullptr || (entry.gone != nullptr && !entry.gone->IsDistinct(from_))) continue;
      const Eigen::Vector3d& offset = origin_.offset_vox;
      entries[count] = &entry;
      batch.x[count] = GridOrigin::ToCentre(entry.index.x, kBlockSide, origin_.voxel.x, offset.x());
      batch.y[count] = GridOrigin::ToCentre(entry.index.y, kBlockSide, origin_.voxel.y, offset.y());
      batch.z[count] = GridOrigin::ToCentre(entry.index.z, kBlockSide, origin_.voxel.z, offset.z());
      if (++count == kLanes) flush();
    }
    if (count > 0) flush();
  }

 private:
  /// The voxel's own size.
  static constexpr float kSlack_vox = 0.5f;
  /// A frame that sees past fewer voxels of a block says nothing: noise strikes single ones, what leaves takes dozens.
  static constexpr int kLeastVoxels = 8;

  /// `x`, `y`, `z`: the block's centre.
  void LookAtBlock(const BlockEntry& entry, float x, float y, float z) {
    const CellBatch octants = ChildrenOf(CellSize::kBlock, x, y, z);
    CellSights sights;
    view_.Classify(octants, sights);
    contradicted_ = {.index = entry.index};
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (sights[i] != CellSight::kHidden) LookAtOctant(entry, i, octants.x[i], octants.y[i], octants.z[i]);
    }
    if (num_balls_ > 0) Decide();
    const VoxelMask& mask = contradicted_.voxels;
    const int count = std::accumulate(mask.begin(), mask.end(), 0,
                                      [](int sum, std::uint64_t word) { return sum + std::popcount(word); });
    if (count >= kLeastVoxels) found_.push_back(contradicted_);
  }

  /// Of the octant's voxels, those before the limit of their own pixel may be contradicted.
  void LookAtOctant(const BlockEntry& entry, std::size_t octant, float x, float y, float z) {
    constexpr float kToFirst = -HalfSpanOf(CellSize::kOctant);
    alignas(64) std::array<std::uint8_t, kOctantVoxels> is_before;
    view_.Test(x + kToFirst, y + kToFirst, z + kToFirst, is_before);
    const TsdfBlock& tsdf = *entry.tsdf;
    const int first = LinearIndex({(octant & 1) != 0 ? kOctantSide : 0, (octant & 2) != 0 ? kOctantSide : 0,
                                   (octant & 4) != 0 ? kOctantSide : 0});
    // Without branches: of what a sensor looks through, hardly anything is at a surface.
    for (int row = 0; row < kOctantSide * kOctantSide; ++row) {
      const auto at = static_cast<std::size_t>(first + kBlockSide * ((row & 3) + kBlockSide * (row >> 2)));
      for (std::size_t dx = 0; dx < kOctantSide; ++dx) {
        const bool is_near = tsdf.weight[at + dx] >= kMinObservedWeight && std::abs(tsdf.distance_m[at + dx]) < most_m_;
        is_before[static_cast<std::size_t>(row) * kOctantSide + dx] &= static_cast<std::uint8_t>(is_near);
      }
    }
    for (int i = 0; i < kOctantVoxels; ++i) {
      if ((i & 7) == 0 && !HasAny(is_before.data() + i)) {
        i += 7;
        continue;
      }
      if (is_before[static_cast<std::size_t>(i)] == 0) continue;
      const int dx = i & 3, dy = i >> 2 & 3, dz = i >> 4;
      const int linear = first + dx + kBlockSide * (dy + kBlockSide * dz);
      if (entry.IsContradicted(linear)) continue;
      const float distance_m = tsdf.distance_m[static_cast<std::size_t>(linear)];
      balls_.x[num_balls_] = x + kToFirst + static_cast<float>(dx);
      balls_.y[num_balls_] = y + kToFirst + static_cast<float>(dy);
      balls_.z[num_balls_] = z + kToFirst + static_cast<float>(dz);
      balls_.radius[num_balls_] = std::abs(distance_m) * voxels_per_m_ + kSlack_vox;
      linear_[num_balls_] = linear;
      if (++num_balls_ == kLanes) Decide();
    }
  }

  static bool HasAny(const std::uint8_t* eight) {
    std::uint64_t word;
    std::memcpy(&word, eight, sizeof(word));
    return word != 0;
  }

  void Decide() {
    std::array<bool, kLanes> is_past;
    view_.LookPast(balls_, is_past);
    for (std::size_t i = 0; i < num_balls_; ++i) {
      if (!is_past[i]) continue;
      contradicted_.voxels[static_cast<std::size_t>(linear_[i] >> 6)] |= std::uint64_t{1} << (linear_[i] & 63);
    }
    num_balls_ = 0;
  }

  const View& view_;
  const GridOrigin& origin_;
  const Viewpoint& from_;
  const float voxels_per_m_, most_m_;
  std::vector<ContradictedBlock>& found_;
  ContradictedBlock contradicted_;
  BallBatch balls_;
  std::array<int, kLanes> linear_{};
  std::size_t num_balls_ = 0;
};

}  // namespace dhpmap
