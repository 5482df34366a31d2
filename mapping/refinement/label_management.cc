// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_management.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/refinement/submap_labels.h"
#include "mapping/refinement/voxel_merge.h"

namespace dhpmap {
namespace {

/// One submap's block at a position that has to be looked at.
struct Holder {
  SubmapId id;
  const BlockEntry* before;         ///< null: the submap had no block here
  std::shared_ptr<TsdfBlock> tsdf;  ///< what it has afterwards; null while nothing changed
  std::shared_ptr<LabelBlock> labels;
};

/// All submaps that hold a block at one index, by ascending id.
struct Position {
  BlockIndex index;
  std::vector<Holder> holders;
  std::int64_t num_shared = 0, num_moved = 0;
};

bool IsOnMapGrid(const Submap& submap, const MapConfig& config) {
  return IsIdentity(submap.info().T_map_submap) && submap.info().voxel_size_m == config.voxel_size_m;
}

/// Blocks that more than one submap holds, and blocks with a voxel that belongs elsewhere; by ascending index.
std::vector<Position> FindPositions(const std::vector<const Submap*>& submaps) {
  std::unordered_map<BlockIndex, std::vector<Holder>, BlockIndexHash> holders_at;
  for (const Submap* submap : submaps) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.tsdf) holders_at[entry.index].push_back({submap->id(), &entry, nullptr, nullptr});
    }
  }
  std::vector<Position> positions;
  for (auto& [index, holders] : holders_at) {
    const bool has_foreign_voxel =
        holders.size() == 1 && holders[0].before->labels && HasForeignVoxel(*holders[0].before->labels);
    if (holders.size() > 1 || has_foreign_voxel) positions.push_back({index, std::move(holders)});
  }
  std::sort(positions.begin(), positions.end(), [](const Position& a, const Position& b) { return a.index < b.index; });
  return positions;
}

/// The holder that a merged voxel goes to: that of its winning instance, which may have had no block here yet.
Holder& WinnerOf(const MergedVoxel& voxel, const std::vector<SubmapId>& ids, Position& position) {
  SubmapId winner = voxel.first_holder;
  std::uint32_t most = 0;
  for (const LabelCount& instance : voxel.histograms.instances) {
    const SubmapId id(instance.id);
    if (instance.count > most && std::binary_search(ids.begin(), ids.end(), id)) {
      winner = id;
      most = instance.count;
    }
  }
  auto it = std::lower_bound(position.holders.begin(), position.holders.end(), winner,
                             [](const Holder& holder, SubmapId id) { return holder.id < id; });
  if (it == position.holders.end() || it->id != winner) {
    it = position.holders.insert(it, {winner, nullptr, nullptr, nullptr});
  }
  return *it;
}

void MakeWritable(Holder& holder) {
  if (holder.tsdf) return;
  const bool had_tsdf = holder.before != nullptr && holder.before->tsdf != nullptr;
  const bool had_labels = holder.before != nullptr && holder.before->labels != nullptr;
  holder.tsdf = had_tsdf ? std::make_shared<TsdfBlock>(*holder.before->tsdf) : std::make_shared<TsdfBlock>();
  holder.labels = had_labels ? std::make_shared<LabelBlock>(*holder.before->labels) : std::make_shared<LabelBlock>();
}

/// Whether the voxel is nobody else's: held once, and by the instance seen most often.
bool IsSettledVoxel(const Position& position, int linear) {
  const Holder* holder = nullptr;
  for (const Holder& candidate : position.holders) {
    if (candidate.before == nullptr || !candidate.before->tsdf->IsObserved(linear)) continue;
    if (holder != nullptr) return false;
    holder = &candidate;
  }
  if (holder == nullptr) return true;
  if (holder->before->labels == nullptr) return true;
  std::uint32_t own = 0, most = 0;
  holder->before->labels->VisitInstances(linear, [&](LabelCount seen) {
    (seen.id == 0 ? own : most) = seen.id == 0 ? seen.count : std::max(most, seen.count);
  });
  return own > most || most == 0;
}

/// Settles every voxel of one block position. Touches nothing but `position`.
void SettlePosition(const std::vector<SubmapId>& ids, Position& position) {
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (IsSettledVoxel(position, linear)) continue;
    MergedVoxel merged;
    for (const Holder& holder : position.holders) {
      if (holder.before != nullptr && holder.before->tsdf->IsObserved(linear)) {
        Accumulate(*holder.before, holder.id, linear, merged);
      }
    }
    const SubmapId winner = WinnerOf(merged, ids, position).id;
    if (merged.num_holders == 1 && merged.first_holder == winner) continue;
    if (merged.num_holders > 1) ++position.num_shared;
    for (Holder& holder : position.holders) {
      const bool held = holder.before != nullptr && holder.before->tsdf->IsObserved(linear);
      if (!held && holder.id != winner) continue;
      MakeWritable(holder);
      if (holder.id == winner) {
        Store(merged, winner, linear, *holder.tsdf, *holder.labels);
      } else {
        Clear(linear, *holder.tsdf, *holder.labels);
        ++position.num_moved;
      }
    }
  }
}

}  // namespace

ManagementReport ManageLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool) {
  ManagementReport report;
  std::vector<const Submap*> submaps;
  std::vector<SubmapId> merging;
  std::vector<SubmapId> sorted(ids.begin(), ids.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const SubmapId id : sorted) {
    const Submap* submap = map.Find(id);
    if (submap == nullptr) continue;
    if (!IsOnMapGrid(*submap, map.info().config)) {
      ++report.num_skipped_submaps;
      continue;
    }
    submaps.push_back(submap);
    merging.push_back(id);
  }

  std::vector<Position> positions = FindPositions(submaps);
  pool.ParallelFor(positions.size(), [&](std::size_t i) { SettlePosition(merging, positions[i]); });

  std::vector<SubmapId> changed;
  for (Position& position : positions) {
    report.num_shared_voxels += position.num_shared;
    report.num_moved_voxels += position.num_moved;
    for (Holder& holder : position.holders) {
      if (holder.tsdf == nullptr) continue;
      Submap& submap = *map.FindMutable(holder.id);
      const bool has_labels = holder.id != kUnknownSubmap;
      submap.PutBlock(position.index, std::move(holder.tsdf), has_labels ? std::move(holder.labels) : nullptr);
      changed.push_back(holder.id);
    }
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const SubmapId id : changed) {
    Submap& submap = *map.FindMutable(id);
    submap.PruneBlocks();
    if (submap.blocks().empty() && id != kUnknownSubmap) {
      report.num_removed_submaps += map.Remove(id) ? 1 : 0;
      continue;
    }
    submap.UpdateBoundingSphere();
    RecomputeSubmapLabels(submap);
  }
  return report;
}

}  // namespace dhpmap
