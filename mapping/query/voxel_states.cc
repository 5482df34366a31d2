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
#include "mapping/surfaces/look_into_cell.h"

namespace dhpmap {
namespace {

/// 2 to 3 MB; in a slice of about 100 m with a band of a few metres, all blocks of several rows of cells.
constexpr std::size_t kMostBlocks = 16384;

constexpr bool HasVoxel(const FreeMask& mask, int linear) {
  return (mask[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0;
}
constexpr void Set(FreeMask& mask, int linear) {
  mask[static_cast<std::size_t>(linear >> 6)] |= std::uint64_t{1} << (linear & 63);
}

}  // namespace

/// Combines the submaps' voxels of one block.
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
      block_.free[z] = (free_[z] | left_[z] | in_front_[z]) & ~block_.inside[z];
    }
    return std::move(block_);
  }

 private:
  void Take(int i, std::uint32_t number, const VoxelSample& voxel) {
    if (!voxel.IsObserved()) return;
    const float distance_m = voxel.distance_m();
    if (distance_m > 0) return Set(in_front_, i);
    if (HasVoxel(looked_through_, i)) return;
    Set(block_.inside, i);
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
  std::array<float, kBlockVoxels> nearest_m_;  // valid once something is occupied
  Block block_;
};

VoxelStates::VoxelStates(const std::shared_ptr<const MapSurfaces>& surfaces, const DistanceOptions& options,
                         bool with_objects)
    : world_(surfaces, options.scope),
      distances_(surfaces, options),
      with_objects_(with_objects),
      max_distance_m_(options.max_distance_m),
      keeps_(world_.TakesAllAsItIs() && options.max_distance_m <= CellSlots::kReach_m),
      voxel_size_m_(world_.voxel_size_m()),
      reach_m_(GridReach_m(voxel_size_m_)) {}

VoxelStates::Block* VoxelStates::BlockOfPoint(const Eigen::Vector3d& p_map, int& linear) {
  if (!(p_map.array().abs() <= reach_m_).all()) return nullptr;
  const VoxelIndex voxel = VoxelAt(p_map, voxel_size_m_);
  const BlockIndex index = BlockOf(voxel);
  if (last_ == nullptr || index != last_index_) {
    last_ = &BlockAt(index);
    last_index_ = index;
  }
  linear = LinearIndex(voxel);
  return last_;
}

VoxelStates::Voxel VoxelStates::At(const Eigen::Vector3d& p_map) {
  int i = 0;
  const Block* block = BlockOfPoint(p_map, i);
  if (block == nullptr) return {};
  if (HasVoxel(block->free, i)) return {.state = VoxelState::kFree};
  if (!HasVoxel(block->inside, i)) return {};
  if (block->numbers.empty()) return {.state = VoxelState::kInside};
  const std::uint32_t number = block->numbers[static_cast<std::size_t>(i)];
  return {.state = VoxelState::kInside, .submap = &world_.surfaces().index().entries()[number].submap().info()};
}

VoxelStates::Voxel VoxelStates::UnseenAt(const Eigen::Vector3d& p_map) {
  int linear = 0;
  Block* block = BlockOfPoint(p_map, linear);
  if (block == nullptr) return {};
  if (!block->is_behind_known) LookBehind(*block);
  if (!HasVoxel(block->behind, linear)) return {};
  const auto& whom = block->behind_whom;
  return {.state = VoxelState::kInside, .submap = whom.empty() ? nullptr : whom[static_cast<std::size_t>(linear)]};
}

FreeMask VoxelStates::Block::Unknown() const {
  FreeMask unknown{};
  for (std::size_t word = 0; word < unknown.size(); ++word) unknown[word] = ~(free[word] | inside[word]);
  return unknown;
}

/// For the block requested last.
void VoxelStates::LookBehind(Block& block) {
  block.is_behind_known = true;
  const FreeMask unknown = block.Unknown();
  const UnseenInside* told = FindKept(unknown);
  std::unique_ptr<const UnseenInside> asked;
  if (told == nullptr) {
    asked = AskBehind(unknown);
    told = asked.get();
  }
  for (std::size_t word = 0; word < unknown.size(); ++word) block.behind[word] = told->inside[word] & unknown[word];
  if (with_objects_ && !told->whose.empty()) {
    block.behind_whom.resize(kBlockVoxels);
    const MapSurfaces& surfaces = world_.surfaces();
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!HasVoxel(block.behind, i)) continue;
      const std::size_t number = surfaces.NumberOf(told->WhoseAt(i));
      block.behind_whom[static_cast<std::size_t>(i)] = &surfaces.index().entries()[number].submap().info();
    }
  }
  if (keeps_ && asked != nullptr)
    world_.surfaces().cells().Keep(VoxelCentre(VoxelIn(last_index_, 0), voxel_size_m_), std::move(asked));
}

const UnseenInside* VoxelStates::FindKept(const FreeMask& unknown) const {
  if (!keeps_) return nullptr;
  const MapSurfaces& surfaces = world_.surfaces();
  const NearbyCell* cell =
      surfaces.cells().FindOrTakeOver(LookOf(surfaces), VoxelCentre(VoxelIn(last_index_, 0), voxel_size_m_));
  const UnseenInside* kept = cell == nullptr ? nullptr : cell->unseen_inside.load(std::memory_order_acquire);
  return kept != nullptr && kept->TellsOf(unknown, max_distance_m_) ? kept : nullptr;
}

std::unique_ptr<const UnseenInside> VoxelStates::AskBehind(const FreeMask& unknown) const {
  auto told = std::make_unique<UnseenInside>();
  told->max_distance_m = max_distance_m_;
  told->asked = unknown;
  if (keeps_) told->things = ThingsAround(world_.surfaces(), last_index_);
  std::vector<Eigen::Vector3d> centres;
  std::vector<int> voxels;
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (!HasVoxel(unknown, i)) continue;
    voxels.push_back(i);
    centres.push_back(VoxelCentre(VoxelIn(last_index_, i), voxel_size_m_));
  }
  std::vector<SurfaceDistance> distances(centres.size());
  distances_.AtInOrder(centres, distances);
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (!(distances[i].distance_m < 0)) continue;
    Set(told->inside, voxels[i]);
    const SubmapId whose = distances[i].submap->id;
    if (told->whose.empty() || told->whose.back().whose != whose) told->whose.push_back({0, whose});
    told->whose.back().end = static_cast<std::uint16_t>(voxels[i] + 1);
  }
  return told;
}

VoxelStates::Block& VoxelStates::BlockAt(BlockIndex index) {
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
