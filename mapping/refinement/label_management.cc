// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_management.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/map/map_grid.h"
#include "mapping/refinement/submap_labels.h"
#include "mapping/refinement/voxel_merge.h"

namespace dhpmap {
namespace {

/// So that what was written twice in one refinement is never all in memory twice.
constexpr std::size_t kPositionsAtOnce = 512;

/// One submap's block at a position that has to be looked at.
struct Holder {
  SubmapId id;
  BlockEntry before;                ///< without geometry: the submap had no block here
  std::shared_ptr<TsdfBlock> tsdf;  ///< what it has afterwards; null while nothing changed, and where nothing is left
  std::shared_ptr<LabelBlock> labels;
  std::shared_ptr<GoneBlock> gone;  ///< null: as before
  bool is_emptied = false;
};

/// All submaps that hold a block at one index, by ascending id.
struct Position {
  BlockIndex index;
  std::vector<Holder> holders;
  std::int64_t num_shared = 0, num_moved = 0;
};

/// Blocks that more than one submap holds, and blocks with a voxel that belongs elsewhere; by ascending index.
std::vector<Position> FindPositions(const std::vector<const Submap*>& submaps) {
  std::unordered_map<BlockIndex, std::vector<Holder>, BlockIndexHash> holders_at;
  for (const Submap* submap : submaps) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.tsdf) holders_at[entry.index].push_back({.id = submap->id(), .before = entry});
    }
  }
  std::vector<Position> positions;
  for (auto& [index, holders] : holders_at) {
    const bool has_foreign_voxel =
        holders.size() == 1 && holders[0].before.labels && HasForeignVoxel(*holders[0].before.labels);
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
    it = position.holders.insert(it, {.id = winner});
  }
  return *it;
}

void MakeWritable(Holder& holder) {
  if (holder.tsdf) return;
  const auto& [tsdf, labels] = std::tie(holder.before.tsdf, holder.before.labels);
  // Not made by make_shared: StateMarks would keep their memory.
  holder.tsdf.reset(tsdf ? new TsdfBlock(*tsdf) : new TsdfBlock());
  holder.labels.reset(labels ? new LabelBlock(*labels) : new LabelBlock());
}

enum class Scope { kAll, kForeign };

/// What is contradicted stays with its submap, and has no say.
bool IsHeld(const Holder& holder, int linear) { return holder.before.tsdf != nullptr && holder.before.Shows(linear); }

/// A voxel that a holder is given was observed, whatever was looked through there before.
void Forget(int linear, Holder& holder) {
  if (holder.before.gone == nullptr || holder.before.gone->Count(linear) == 0) return;
  if (holder.gone == nullptr) holder.gone = std::make_shared<GoneBlock>(*holder.before.gone);
  holder.gone->Forget(linear);
}

/// Whether the holder is the instance that its voxel has seen most; ties go to the smaller id.
bool IsAtHome(const Holder& holder, int linear) {
  if (holder.before.labels == nullptr) return true;
  std::uint32_t own = 0, most = 0;
  bool is_tied_to_smaller = false;
  holder.before.labels->VisitInstances(linear, [&](LabelCount seen) {
    if (seen.id == 0) own = seen.count;
    else if (seen.count > most) most = seen.count, is_tied_to_smaller = seen.id < holder.id.value;
    else if (seen.count == most) is_tied_to_smaller = is_tied_to_smaller || seen.id < holder.id.value;
  });
  return own > most || (own == most && !is_tied_to_smaller);
}

/// Whether the voxel can stay as it is.
bool IsSettledVoxel(const Position& position, int linear, Scope scope) {
  int num_holders = 0;
  bool all_at_home = true;
  for (const Holder& holder : position.holders) {
    if (!IsHeld(holder, linear)) continue;
    ++num_holders;
    all_at_home = all_at_home && IsAtHome(holder, linear);
  }
  return all_at_home && (num_holders <= 1 || scope == Scope::kForeign);
}

/// Most of those who lose a voxel to others have none left in the block.
void DropIfEmpty(Holder& holder) {
  if (holder.tsdf == nullptr || holder.tsdf->HasObservedVoxel()) return;
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (!holder.labels->IsEmpty(linear)) return;
  }
  holder.tsdf = nullptr;
  holder.labels = nullptr;
  holder.is_emptied = true;
}

/// Settles every voxel of one block position. Touches nothing but `position`.
void SettlePosition(const std::vector<SubmapId>& ids, Scope scope, Position& position) {
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (IsSettledVoxel(position, linear, scope)) continue;
    MergedVoxel merged;
    for (const Holder& holder : position.holders) {
      if (IsHeld(holder, linear)) Accumulate(holder.before, holder.id, linear, merged);
    }
    const SubmapId winner = WinnerOf(merged, ids, position).id;
    if (merged.num_holders == 1 && merged.first_holder == winner) continue;
    if (merged.num_holders > 1) ++position.num_shared;
    for (Holder& holder : position.holders) {
      if (!IsHeld(holder, linear) && holder.id != winner) continue;
      MakeWritable(holder);
      if (holder.id == winner) {
        if (!IsHeld(holder, linear)) Forget(linear, holder);
        Store(merged, winner, linear, *holder.tsdf, *holder.labels);
      } else {
        Clear(linear, *holder.tsdf, *holder.labels);
        ++position.num_moved;
      }
    }
  }
  for (Holder& holder : position.holders) DropIfEmpty(holder);
}

/// Puts a settled position into the map, and lets go of what was there.
void PutPosition(Position& position, Map& map, std::vector<SubmapId>& changed) {
  for (Holder& holder : position.holders) {
    if (holder.tsdf == nullptr && !holder.is_emptied) continue;
    Submap& submap = *map.FindMutable(holder.id);
    const bool has_labels = holder.id != kUnknownSubmap;
    if (holder.is_emptied) submap.EraseBlock(position.index);
    else submap.PutBlock(position.index, std::move(holder.tsdf), has_labels ? std::move(holder.labels) : nullptr);
    if (holder.gone != nullptr) submap.PutGone(position.index, holder.gone->empty() ? nullptr : std::move(holder.gone));
    changed.push_back(holder.id);
  }
  position.holders = {};
}

ManagementReport Settle(std::span<const SubmapId> ids, Scope scope, Map& map, ThreadPool& pool) {
  ManagementReport report;
  std::vector<const Submap*> submaps;
  std::vector<SubmapId> merging;
  std::vector<SubmapId> sorted(ids.begin(), ids.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const SubmapId id : sorted) {
    const Submap* submap = map.Find(id);
    if (submap == nullptr) continue;
    if (!IsOnMapGrid(submap->info(), map.info().config)) {
      ++report.num_skipped_submaps;
      continue;
    }
    submaps.push_back(submap);
    merging.push_back(id);
  }

  std::vector<Position> positions = FindPositions(submaps);
  std::vector<SubmapId> changed;
  for (std::size_t begin = 0; begin < positions.size(); begin += kPositionsAtOnce) {
    const std::span some(positions.data() + begin, std::min(kPositionsAtOnce, positions.size() - begin));
    pool.ParallelFor(some.size(), [&](std::size_t i) { SettlePosition(merging, scope, some[i]); });
    for (Position& position : some) {
      report.num_shared_voxels += position.num_shared;
      report.num_moved_voxels += position.num_moved;
      PutPosition(position, map, changed);
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

}  // namespace

ManagementReport ManageLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool) {
  return Settle(ids, Scope::kAll, map, pool);
}

ManagementReport MoveForeignVoxels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool) {
  return Settle(ids, Scope::kForeign, map, pool);
}

}  // namespace dhpmap
