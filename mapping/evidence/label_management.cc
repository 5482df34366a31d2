// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/label_management.h"

#include <algorithm>
#include <functional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/base/refinement_scratch.h"
#include "mapping/evidence/block_position.h"
#include "mapping/evidence/known_instances.h"
#include "mapping/evidence/voxel_merge.h"

namespace dhpmap {
namespace {

using HoldersAt = std::unordered_map<BlockIndex, ScratchVector<Holder>, BlockIndexHash, std::equal_to<>,
                                     ScratchAllocator<std::pair<const BlockIndex, ScratchVector<Holder>>>>;

/// Blocks that more than one submap holds, and blocks with a voxel that belongs elsewhere; by ascending index.
ScratchVector<Position> FindPositions(const KnownInstances& known, const Map& map, const RefinementRegion* region,
                                      int rim) {
  HoldersAt holders_at;
  for (const SubmapId id : known.ids()) {
    for (const BlockEntry& entry : map.Find(id)->blocks().entries()) {
      if (region != nullptr && !region->IsNear(entry.index, rim)) continue;
      if (entry.tsdf) holders_at[entry.index].push_back({.id = id, .before = entry});
    }
  }
  ScratchVector<Position> positions;
  for (auto& [index, holders] : holders_at) {
    const bool has_foreign_voxel =
        holders.size() == 1 && holders[0].before.labels && HasForeignVoxel(*holders[0].before.labels);
    if (holders.size() > 1 || has_foreign_voxel) positions.push_back({index, std::move(holders)});
  }
  std::sort(positions.begin(), positions.end(), [](const Position& a, const Position& b) { return a.index < b.index; });
  return positions;
}

/// Whether the holder is the instance that its voxel has seen most (ties go to the smaller id), or has it by
/// conclusion.
bool IsAtHome(const Holder& holder, int linear) {
  if (holder.before.labels == nullptr || holder.before.labels->IsConcluded(linear)) return true;
  std::uint32_t own = 0, most = 0;
  bool is_tied_to_smaller = false;
  holder.before.labels->VisitInstances(linear, [&](InstanceCount seen) {
    const bool is_smaller = seen.id.In(holder.id) < holder.id;
    if (seen.id.IsOwn()) own = seen.count;
    else if (seen.count > most) most = seen.count, is_tied_to_smaller = is_smaller;
    else if (seen.count == most) is_tied_to_smaller = is_tied_to_smaller || is_smaller;
  });
  return own > most || (own == most && !is_tied_to_smaller);
}

/// Whether the voxel can stay as it is.
bool IsSettledVoxel(const Position& position, int linear) {
  int num_holders = 0;
  bool all_at_home = true;
  for (const Holder& holder : position.holders) {
    if (!holder.Holds(linear)) continue;
    ++num_holders;
    all_at_home = all_at_home && IsAtHome(holder, linear);
  }
  return all_at_home && num_holders <= 1;
}

/// Who gets a merged voxel: its winning instance, which may have had no block here yet.
SubmapId WinnerOf(const MergedVoxel& voxel, const KnownInstances& known) {
  SubmapCount most;
  for (const SubmapCount& instance : voxel.instances) {
    if (instance.count > most.count && known.Has(instance.id)) most = instance;
  }
  return most.count > 0 ? most.id : voxel.first_holder;
}

/// Settles every voxel of one block position. Touches nothing but `position`.
void SettlePosition(const KnownInstances& known, Position& position) {
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (IsSettledVoxel(position, linear)) continue;
    MergedVoxel merged;
    for (const Holder& holder : position.holders) {
      if (holder.Holds(linear)) Accumulate(holder.before, holder.id, linear, merged);
    }
    const SubmapId winner = WinnerOf(merged, known);
    if (merged.num_holders == 1 && merged.first_holder == winner) continue;
    if (merged.num_holders > 1) ++position.num_shared;
    position.Give(linear, merged, winner, false);
    for (Holder& holder : position.holders) {
      if (holder.id != winner && holder.Holds(linear)) position.Take(linear, holder);
    }
  }
  position.DropEmptyBlocks();
}

}  // namespace

ManagementReport ManageLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool, const RefinementRegion* region,
                              int rim) {
  ManagementReport report;
  const KnownInstances known(ids, map);
  const std::set<SubmapId> named(ids.begin(), ids.end());
  for (const SubmapId id : named) report.num_skipped_submaps += map.Find(id) != nullptr && !known.Has(id);
  ScratchVector<Position> positions = FindPositions(known, map, region, rim);
  std::vector<SubmapId> changed;
  for (std::size_t begin = 0; begin < positions.size(); begin += kPositionsAtOnce) {
    const std::span some(positions.data() + begin, std::min(kPositionsAtOnce, positions.size() - begin));
    pool.ParallelFor(some.size(), [&](std::size_t i) { SettlePosition(known, some[i]); });
    for (Position& position : some) {
      report.num_shared_voxels += position.num_shared;
      report.num_moved_voxels += position.num_moved;
      PutPosition(position, map, changed);
    }
  }
  report.num_removed_submaps = TidySubmaps(std::move(changed), map);
  return report;
}

}  // namespace dhpmap
