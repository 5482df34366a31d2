// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/split_submap.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "mapping/evidence/submap_labels.h"
#include "mapping/objects/voxel_transfer.h"

namespace dhpmap {
namespace {

struct Counted {
  VoxelSet voxels;
  std::int64_t num_voxels = 0, num_others = 0;
};

Counted Choose(const Submap& submap, const VoxelChoice& goes) {
  Counted chosen;
  const double voxel_size_m = submap.info().voxel_size_m;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    std::bitset<kBlockVoxels> of_block;
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!HasVoxel(entry, i)) continue;
      const bool is_chosen = goes(VoxelCentre(VoxelIn(entry.index, i), voxel_size_m));
      of_block[static_cast<std::size_t>(i)] = is_chosen;
      ++(is_chosen ? chosen.num_voxels : chosen.num_others);
    }
    if (of_block.any()) chosen.voxels.emplace(entry.index, of_block);
  }
  return chosen;
}

/// Without voxel labels: splits observations in proportion to voxels.
void ShareTotals(double share, SubmapInfo& rest, SubmapInfo& part) {
  part.class_counts.clear();
  for (ClassTotal& total : rest.class_counts) {
    const auto given = static_cast<std::uint64_t>(share * static_cast<double>(total.count));
    if (given == 0) continue;
    part.class_counts.push_back({total.id, given});
    total.count -= given;
  }
}

SubmapId MakePart(SubmapId id, const VoxelSet& voxels, double share, Map& map) {
  SubmapInfo info = map.Find(id)->info();
  info.display_name.clear();
  info.track_id = 0;
  info.sightings = {};
  info.is_confirmed = true;  // because a user requested it
  Submap& part = map.Create(std::move(info));
  Submap& rest = *map.FindMutable(id);
  ShareTotals(share, rest.mutable_info(), part.mutable_info());
  MoveVoxels(voxels, rest, part);
  for (Submap* submap : {&part, &rest}) {
    submap->PruneBlocks();
    RecomputeSubmapLabels(*submap);
    submap->UpdateBoundingSphere();
  }
  map.mutable_info().pairs.SetVerdict(id, part.id(), PairVerdict::kMustBeTwo);
  return part.id();
}

/// The connected parts of the visible voxels, each as a list.
class Parts {
 public:
  explicit Parts(const Submap& submap) {
    for (const BlockEntry& entry : submap.blocks().entries()) {
      std::bitset<kBlockVoxels>& open = open_[entry.index];
      for (int i = 0; i < kBlockVoxels; ++i) {
        open[static_cast<std::size_t>(i)] = entry.tsdf != nullptr && entry.Shows(i);
      }
    }
    for (const BlockEntry& entry : submap.blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        const VoxelIndex seed = VoxelIn(entry.index, i);
        if (Take(seed)) list_.push_back(Grow(seed));
      }
    }
    for (auto& part : list_) std::iter_swap(part.begin(), std::min_element(part.begin(), part.end()));
    // On ties the one with the smaller first voxel: the order of blocks in memory may change on loading.
    std::sort(list_.begin(), list_.end(), [](const auto& a, const auto& b) {
      return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
    });
  }
  [[nodiscard]] const std::vector<std::vector<VoxelIndex>>& list() const { return list_; }

 private:
  bool Take(VoxelIndex v) {
    const auto found = open_.find(BlockOf(v));
    const auto i = static_cast<std::size_t>(LinearIndex(v));
    if (found == open_.end() || !found->second[i]) return false;
    found->second[i] = false;
    return true;
  }
  std::vector<VoxelIndex> Grow(VoxelIndex seed) {
    std::vector<VoxelIndex> part{seed};
    for (std::size_t next = 0; next < part.size(); ++next) {
      const VoxelIndex v = part[next];
      for (int n = 0; n < 27; ++n) {
        const VoxelIndex neighbour{v.x + n % 3 - 1, v.y + n / 3 % 3 - 1, v.z + n / 9 - 1};
        if (Take(neighbour)) part.push_back(neighbour);
      }
    }
    return part;
  }

  std::unordered_map<BlockIndex, std::bitset<kBlockVoxels>, BlockIndexHash> open_;
  std::vector<std::vector<VoxelIndex>> list_;
};

}  // namespace

std::optional<SubmapId> SplitSubmap(SubmapId id, const VoxelChoice& goes, Map& map) {
  const Counted chosen = Choose(*map.Find(id), goes);
  if (chosen.num_voxels == 0 || chosen.num_others == 0) return std::nullopt;
  const auto all = static_cast<double>(chosen.num_voxels + chosen.num_others);
  return MakePart(id, chosen.voxels, static_cast<double>(chosen.num_voxels) / all, map);
}

std::vector<SubmapId> SplitIntoConnectedParts(SubmapId id, std::size_t least_voxels, std::size_t most_parts, Map& map) {
  const Parts parts(*map.Find(id));
  std::size_t num_left = 0;
  for (const auto& part : parts.list()) num_left += part.size();
  std::vector<SubmapId> made;
  for (std::size_t p = 1; p < parts.list().size() && made.size() + 1 < most_parts; ++p) {
    const std::vector<VoxelIndex>& part = parts.list()[p];
    if (part.size() < least_voxels) break;
    VoxelSet voxels;
    for (const VoxelIndex v : part) voxels[BlockOf(v)].set(static_cast<std::size_t>(LinearIndex(v)));
    made.push_back(MakePart(id, voxels, static_cast<double>(part.size()) / static_cast<double>(num_left), map));
    num_left -= part.size();
  }
  for (std::size_t a = 0; a < made.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) map.mutable_info().pairs.SetVerdict(made[a], made[b], PairVerdict::kMustBeTwo);
  }
  return made;
}

void MakeThingOfClass(ClassId class_id, Submap& part) {
  SubmapInfo& info = part.mutable_info();
  if (info.panoptic != Panoptic::kThing) info.activity = Activity::kInactive;
  info.panoptic = Panoptic::kThing;
  info.class_id = class_id;
  info.class_is_fixed = true;
}

}  // namespace dhpmap
