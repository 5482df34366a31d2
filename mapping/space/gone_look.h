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

#include "mapping/base/index_map.h"
#include "mapping/space/cell.h"
#include "mapping/space/grid_origin.h"
#include "mapping/space/surface_claims.h"
#include "mapping/voxels/block_table.h"
#include "mapping/voxels/voxel_mask.h"

namespace dhpmap {

inline int NumIn(const VoxelMask& mask) {
  return std::accumulate(mask.begin(), mask.end(), 0,
                         [](int sum, std::uint64_t word) { return sum + std::popcount(word); });
}

/// The blocks of a grid that have gone voxels, in any submap.
class LeftBlocks {
 public:
  void Clear() {
    at_ = {};
    counts_.clear();
  }
  /// Records that `num_voxels` more voxels of the block are contradicted.
  void Add(BlockIndex block, int num_voxels) {
    const std::uint32_t known = at_.Find(block);
    if (known != IndexMap<BlockIndex>::kNone) {
      counts_[known] += num_voxels;
      return;
    }
    at_.Set(block, static_cast<std::uint32_t>(counts_.size()));
    counts_.push_back(num_voxels);
  }
  [[nodiscard]] int CountIn(BlockIndex block) const {
    const std::uint32_t known = at_.Find(block);
    return known == IndexMap<BlockIndex>::kNone ? 0 : counts_[known];
  }

 private:
  IndexMap<BlockIndex> at_;  ///< in `counts_`
  std::vector<int> counts_;
};

/// The result of a look at one block of a submap.
struct ContradictedBlock {
  BlockIndex index;
  VoxelMask voxels{};    ///< newly contradicted
  int num_voxels = 0;    ///< their number
  int num_in_all = 0;    ///< their number, including those contradicted before
  bool is_much = false;  ///< they are a large part of the block's surface
};

/// Looks at one tile of a submap for surfaces that the view looks through.
///
/// A voxel at distance d claims a surface within d. The claim is contradicted if all pixels that a ball of radius d +
/// kSlack_vox may cover see farther than the ball by kMargin_vox, or by the truncation if that is less. If the surface
/// were still there, one of these pixels would see it, or something before it. `View` is CameraView or LidarView. Their
/// limits lie the truncation before what they see; to require less, cells and balls are moved nearer to the sensor.
template <typename View>
class GoneLook {
 public:
  /// Half a voxel, and a little for planes that continue beyond an edge.
  static constexpr float kSlack_vox = 0.6f;
  /// The background must be this far behind: the floor is visible right under an object's foot.
  static constexpr float kMargin_vox = 1.5f;
  /// How far the view's limits may be exceeded: the truncation less kMargin_vox, and for centres of balls less the
  /// smallest radius.
  static float FartherBy_vox(double voxel_size_m, double truncation_m, float least_radius_vox = kSlack_vox) {
    return std::max(0.0f, static_cast<float>(truncation_m / voxel_size_m) - kMargin_vox - least_radius_vox);
  }

  /// `truncation_m` is the submap's; a voxel farther from the surface makes no claim.
  GoneLook(const View& view, const GridOrigin& origin, const Viewpoint& from, const LeftBlocks& left,
           double voxel_size_m, double truncation_m, std::vector<ContradictedBlock>& found)
      : view_(view),
        origin_(origin),
        from_(from),
        left_(left),
        voxels_per_m_(static_cast<float>(1 / voxel_size_m)),
        // Excludes voxels that older versions carved.
        most_m_(static_cast<float>(0.999 * truncation_m)),
        balls_farther_by_vox_(FartherBy_vox(voxel_size_m, truncation_m, 0)),
        farther_by_vox_(FartherBy_vox(voxel_size_m, truncation_m)),
        found_(found) {}

  void Look(const BlockTile& tile) {
    CellBatch batch;
    batch.size = CellSize::kBlock;
    std::array<const BlockEntry*, kLanes> entries{};
    std::size_t count = 0;
    const auto flush = [&] {
      CellSights sights;
      view_.Classify(Nearer(batch, farther_by_vox_), sights);
      for (std::size_t i = 0; i < count; ++i) {
        if (i + 1 < count && sights[i + 1] != CellSight::kHidden) SurfaceClaims::Prefetch(*entries[i + 1]->tsdf);
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
  /// Radius of voxels behind a surface that is partly gone: what is seen there is not inside an object.
  static constexpr float kInside_vox = 0.75f;
  /// If this many voxels of a block, in all submaps, are contradicted, the rest of the surface needs smaller balls.
  /// Such remains are, for example, voxels of the departed object that the wall behind it took over.
  static constexpr int kLeastLeft = 12;

  /// Contradictions of this large a part of a block's surface count twice, because errors at edges are rare there.
  static constexpr int kLeastMuch = 8;
  static constexpr float kMuchShare = 0.3f;

  /// Number of the block's voxels that claim a surface and are not contradicted.
  [[nodiscard]] float CountSaying(const BlockEntry& entry) const {
    int count = claims_.Count();
    if (entry.gone != nullptr) {
      const VoxelMask before = entry.gone->Contradicted();
      for (int linear = 0; linear < kBlockVoxels; ++linear) count -= IsIn(before, linear) && claims_.IsOne(linear);
    }
    return static_cast<float>(count);
  }

  /// `x`, `y`, `z`: the block's centre.
  void LookAtBlock(const BlockEntry& entry, float x, float y, float z) {
    const CellBatch octants = ChildrenOf(CellSize::kBlock, x, y, z);
    CellSights sights;
    view_.Classify(Nearer(octants, farther_by_vox_), sights);
    const auto is_hidden = [](CellSight sight) { return sight == CellSight::kHidden; };
    contradicted_ = {.index = entry.index};
    const int num_before = entry.gone != nullptr ? NumIn(entry.gone->Contradicted()) : 0;
    is_open_ = num_before > 0;
    is_left_ = left_.CountIn(entry.index) >= kLeastLeft;
    if (!std::all_of(sights.begin(), sights.end(), is_hidden)) claims_.Read(*entry.tsdf, most_m_);
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (sights[i] != CellSight::kHidden) LookAtOctant(entry, i, octants.x[i], octants.y[i], octants.z[i]);
    }
    if (num_balls_ > 0) Decide();
    contradicted_.num_voxels = NumIn(contradicted_.voxels);
    contradicted_.num_in_all = contradicted_.num_voxels + num_before;
    contradicted_.is_much = contradicted_.num_voxels >= kLeastMuch &&
                            static_cast<float>(contradicted_.num_voxels) >= kMuchShare * CountSaying(entry);
    if (contradicted_.num_in_all > 0) found_.push_back(contradicted_);
  }

  /// Selects the octant's voxels that lie before the limit of their own pixel, or one beside it.
  void LookAtOctant(const BlockEntry& entry, std::size_t octant, float x, float y, float z) {
    constexpr float kToFirst = -HalfSpanOf(CellSize::kOctant);
    const TsdfBlock& tsdf = *entry.tsdf;
    const int first = LinearIndex({(octant & 1) != 0 ? kOctantSide : 0, (octant & 2) != 0 ? kOctantSide : 0,
                                   (octant & 4) != 0 ? kOctantSide : 0});
    alignas(64) std::array<std::uint8_t, kOctantVoxels> is_near;
    if (!claims_.Of(octant, is_near)) return;
    alignas(64) std::array<std::uint8_t, kOctantVoxels> is_before;
    const float scale = ScaleToNearer(x, y, z, farther_by_vox_);
    view_.Test(scale * x + kToFirst, scale * y + kToFirst, scale * z + kToFirst, is_before);
    for (std::size_t i = 0; i < kOctantVoxels; ++i) is_before[i] &= is_near[i];
    const bool is_remains = is_left_ && HasLeft(is_near, is_before);
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
      const float away_vox = std::abs(distance_m) * voxels_per_m_;
      balls_.radius[num_balls_] = is_remains && away_vox <= 1  ? kSlack_vox
                                  : is_open_ && distance_m < 0 ? kInside_vox
                                                               : away_vox + kSlack_vox;
      linear_[num_balls_] = linear;
      if (++num_balls_ == kLanes) Decide();
    }
  }

  /// Whether nearly all claims of an octant lie before the limits of their centres' pixels.
  static bool HasLeft(const std::array<std::uint8_t, kOctantVoxels>& is_near,
                      const std::array<std::uint8_t, kOctantVoxels>& is_before) {
    const auto count = [](const auto& all) { return std::accumulate(all.begin(), all.end(), 0); };
    return 10 * count(is_before) >= 9 * count(is_near);
  }

  static bool HasAny(const std::uint8_t* eight) {
    std::uint64_t word;
    std::memcpy(&word, eight, sizeof(word));
    return word != 0;
  }

  void Decide() {
    std::array<bool, kLanes> is_past;
    for (std::size_t i = 0; i < num_balls_; ++i) {  // the whole ball scales, so it covers the same pixels
      const float scale = ScaleToNearer(balls_.x[i], balls_.y[i], balls_.z[i], balls_farther_by_vox_);
      balls_.x[i] *= scale, balls_.y[i] *= scale, balls_.z[i] *= scale, balls_.radius[i] *= scale;
    }
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
  const LeftBlocks& left_;
  const float voxels_per_m_, most_m_, balls_farther_by_vox_, farther_by_vox_;
  std::vector<ContradictedBlock>& found_;
  ContradictedBlock contradicted_;
  SurfaceClaims claims_;  ///< of the block, unless it is hidden
  BallBatch balls_;
  std::array<int, kLanes> linear_{};
  std::size_t num_balls_ = 0;
  bool is_open_ = false;  ///< part of the block is gone already
  bool is_left_ = false;  ///< a large part of the blocks at its place is gone
};

}  // namespace dhpmap
