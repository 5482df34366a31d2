// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/tile_problem.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace dhpmap {

TileProblem::TileProblem(std::span<const HeldBlock> blocks, const KnownInstances& known, const CrfTile& tile, int rim,
                         double voxel_size_m)
    : blocks_(blocks), known_(known), voxel_size_m_(voxel_size_m) {
  NumberPlaces(tile);
  AddMembers(tile.inner);
  num_inner_ = members_.size();
  AddMembers(tile.rim);
  AssignChannels(rim);
}

void TileProblem::NumberPlaces(const CrfTile& tile) {
  for (const auto* list : {&tile.inner, &tile.rim}) {
    for (const std::uint32_t b : *list) {
      if (place_numbers_.Find(blocks_[b].index) != IndexMap<BlockIndex>::kNone) continue;
      place_numbers_.Set(blocks_[b].index, static_cast<std::uint32_t>(places_.size()));
      places_.push_back(blocks_[b].index);
    }
  }
  place_numbers_bytes_.Set(place_numbers_.MemoryBytes());
}

void TileProblem::AddMembers(std::span<const std::uint32_t> chosen) {
  for (const std::uint32_t b : chosen) {
    const HeldBlock& block = blocks_[b];
    const std::uint32_t place = place_numbers_.Find(block.index);
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!block.TakesPart(i)) continue;
      members_.push_back({.block = b, .place = place, .linear = static_cast<std::uint16_t>(i)});
    }
  }
}

ScratchVector<CrfPoint> TileProblem::Points() const {
  ScratchVector<CrfPoint> points;
  points.reserve(members_.size());
  const Eigen::Vector3d origin = BlockCorner(places_.front(), voxel_size_m_);
  for (const Member& member : members_) {
    const HeldBlock& block = blocks_[member.block];
    const Eigen::Vector3d p = VoxelCentre(VoxelIn(block.index, member.linear), voxel_size_m_) - origin;
    points.push_back({p.cast<float>(), block.entry->tsdf->color[member.linear]});
  }
  return points;
}

void TileProblem::AssignChannels(int rim) {
  channels_ = LabelChannels(places_.size());
  std::vector<std::uint32_t> instances;  // of one block
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const Member& member = members_[m];
    const HeldBlock& block = blocks_[member.block];
    known_.Visit(block.holder, *block.entry->labels, member.linear,
                 [&](SubmapCount seen) { instances.push_back(seen.id.value); });
    instances.push_back(MostSeen(member).value);
    if (m + 1 < members_.size() && members_[m + 1].block == member.block) continue;
    std::sort(instances.begin(), instances.end());
    instances.erase(std::unique(instances.begin(), instances.end()), instances.end());
    for (const std::uint32_t label : instances) channels_.Add(member.place, label);
    instances.clear();
  }
  std::vector<std::vector<std::uint32_t>> neighbours(places_.size());
  for (std::size_t p = 0; p < places_.size(); ++p) {
    VisitBlocksAround(places_[p], rim, [&](BlockIndex index) {
      const std::uint32_t n = place_numbers_.Find(index);
      if (n != IndexMap<BlockIndex>::kNone) neighbours[p].push_back(n);
    });
  }
  const auto add_bytes = [](std::size_t sum, const auto& list) { return sum + CapacityBytes(list); };
  const CountedBytes neighbours_bytes(MemoryKind::kRefinement, std::accumulate(neighbours.begin(), neighbours.end(),
                                                                               CapacityBytes(neighbours), add_bytes));
  channels_.Assign(neighbours);
}

}  // namespace dhpmap
