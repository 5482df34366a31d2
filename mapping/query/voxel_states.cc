// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/voxel_states.h"

#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "mapping/base/grid_reach.h"
#include "mapping/map/map_grid.h"
#include "mapping/query/voxel_sampler.h"

namespace dhpmap {
namespace {

/// 2 to 3 MB, and for a slice of some 100 m with a band of some metres all blocks of several rows of cells.
constexpr std::size_t kMostBlocks = 16384;

constexpr bool HasVoxel(const FreeMask& mask, int linear) {
  return (mask[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0;
}
constexpr void Set(FreeMask& mask, int linear) {
  mask[static_cast<std::size_t>(linear >> 6)] |= std::uint64_t{1} << (linear & 63);
}

}  // namespace

/// Gathers what the submaps say of one block.
class VoxelStates::Maker {
 public:
  Maker(const QueryWorld& world, BlockIndex index, bool with_objects)
      : surfaces_(world.surfaces()),
        index_(index),
        with_objects_(with_objects),
        looked_through_(world.LookedThrough(index)),
        free_(world.FreeVoxels(index)),
        left_(world.LeftVoxels(index)) {}

  void Ask(std::uint32_t number) {
    const SubmapIndex::Entry& entry = surfaces_.index().entries()[number];
    const Submap& submap = entry.submap();
    const MapConfig& config = surfaces_.state().info().config;
    if (IsOnMapGrid(submap.info(), config)) {
      const BlockEntry* block = submap.blocks().Find(index_);
      for (int i = 0; block != nullptr && i < kBlockVoxels; ++i) {
        Take(i, number, SampleVoxel(*block, i));
      }
      return;
    }
    for (int i = 0; i < kBlockVoxels; ++i) {
      const Eigen::Vector3d p = entry.ToSubmap(VoxelCentre(VoxelIn(index_, i), config.voxel_size_m));
      if (entry.MayHold(p)) Take(i, number, SampleVoxelAt(submap, p));
    }
  }

  Block Finish() {
    for (std::size_t z = 0; z < block_.free.size(); ++z) {
      block_.free[z] = (free_[z] | left_[z] | in_front_[z]) & ~block_.occupied[z];
    }
    return std::move(block_);
  }

 private:
  void Take(int i, std::uint32_t number, const VoxelSample& voxel) {
    if (!voxel.IsObserved()) return;
    const double half_m = 0.5 * (1 + 1e-3) * surfaces_.index().entries()[number].submap().info().voxel_size_m;
    const float distance_m = voxel.distance_m();
    if (distance_m > half_m) return Set(in_front_, i);
    if (distance_m < -half_m && HasVoxel(looked_through_, i)) return;
    Set(block_.occupied, i);
    if (!with_objects_) return;
    if (block_.numbers.empty()) {
      block_.numbers.resize(kBlockVoxels);
      nearest_m_.fill(std::numeric_limits<float>::infinity());
    }
    const auto at = static_cast<std::size_t>(i);
    const std::pair<float, std::uint32_t> best(nearest_m_[at], block_.numbers[at]), now(std::abs(distance_m), number);
    if (now < best) std::tie(nearest_m_[at], block_.numbers[at]) = now;
  }

  const MapSurfaces& surfaces_;
  const BlockIndex index_;
  const bool with_objects_;
  const FreeMask looked_through_, free_, left_;
  FreeMask in_front_{};
  std::array<float, kBlockVoxels> nearest_m_;  // set once anything is occupied
  Block block_;
};

VoxelStates::VoxelStates(std::shared_ptr<const MapSurfaces> surfaces, const QueryScope& scope, bool with_objects)
    : world_(std::move(surfaces), scope),
      with_objects_(with_objects),
      voxel_size_m_(world_.voxel_size_m()),
      reach_m_(GridReach_m(voxel_size_m_)) {}

VoxelStates::Voxel VoxelStates::At(const Eigen::Vector3d& p_map) {
  if (!(p_map.array().abs() <= reach_m_).all()) return {};
  const VoxelIndex voxel = VoxelAt(p_map, voxel_size_m_);
  const BlockIndex index = BlockOf(voxel);
  if (last_ == nullptr || index != last_index_) {
    last_ = &BlockAt(index);
    last_index_ = index;
  }
  const int i = LinearIndex(voxel);
  if (HasVoxel(last_->free, i)) return {.state = VoxelState::kFree};
  if (!HasVoxel(last_->occupied, i)) return {};
  if (last_->numbers.empty()) return {.state = VoxelState::kOccupied};
  const std::uint32_t number = last_->numbers[static_cast<std::size_t>(i)];
  return {.state = VoxelState::kOccupied, .submap = &world_.surfaces().index().entries()[number].submap().info()};
}

const VoxelStates::Block& VoxelStates::BlockAt(BlockIndex index) {
  const auto known = blocks_.find(index);
  if (known != blocks_.end()) return known->second;
  if (blocks_.size() >= kMostBlocks) blocks_.clear();
  const SubmapIndex& submaps = world_.surfaces().index();
  const Eigen::Vector3d corner = BlockCorner(index, voxel_size_m_), voxel = Eigen::Vector3d::Constant(voxel_size_m_);
  Maker maker(world_, index, with_objects_);
  submaps.tree().VisitOverlapping({submaps.InTree(corner - voxel), submaps.InTree(corner + (kBlockSide + 1) * voxel)},
                                  [&](std::size_t position) {
                                    const std::uint32_t number = submaps.tree().items()[position];
                                    if (world_.Holds(number)) maker.Ask(number);
                                  });
  return blocks_.emplace(index, maker.Finish()).first->second;
}

}  // namespace dhpmap
