// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/block_position.h"

#include <algorithm>
#include <utility>

#include "mapping/evidence/submap_labels.h"

namespace dhpmap {
namespace {

void MakeWritable(Holder& holder) {
  if (holder.tsdf) return;
  // Not made by make_shared: StateMarks would keep their memory.
  holder.tsdf.reset(holder.before.tsdf ? new TsdfBlock(*holder.before.tsdf) : new TsdfBlock());
  holder.labels.reset(holder.before.labels ? new LabelBlock(*holder.before.labels) : new LabelBlock());
}

/// A voxel that a holder is given was observed, whatever was looked through there before.
void Forget(int linear, Holder& holder) {
  if (holder.before.gone == nullptr || holder.before.gone->Count(linear) == 0) return;
  if (holder.gone == nullptr) holder.gone = std::make_shared<GoneBlock>(*holder.before.gone);
  holder.gone->Forget(linear);
}

}  // namespace

Holder& Position::HolderOf(SubmapId id) {
  auto it = std::lower_bound(holders.begin(), holders.end(), id,
                             [](const Holder& holder, SubmapId wanted) { return holder.id < wanted; });
  if (it == holders.end() || it->id != id) it = holders.insert(it, {.id = id});
  return *it;
}

void Position::Give(int linear, const MergedVoxel& merged, SubmapId winner, bool is_concluded) {
  Holder& holder = HolderOf(winner);
  MakeWritable(holder);
  if (!holder.Holds(linear)) Forget(linear, holder);
  Store(merged, winner, linear, *holder.tsdf, *holder.labels);
  holder.labels->SetConcluded(linear, is_concluded);
}

void Position::Take(int linear, Holder& holder) {
  MakeWritable(holder);
  Clear(linear, *holder.tsdf, *holder.labels);
  ++num_moved;
}

void Position::DropEmptyBlocks() {
  for (Holder& holder : holders) {
    if (holder.tsdf == nullptr || holder.tsdf->HasObservedVoxel()) continue;
    bool is_empty = true;
    for (int linear = 0; linear < kBlockVoxels && is_empty; ++linear) is_empty = holder.labels->IsEmpty(linear);
    if (!is_empty) continue;
    holder.tsdf = nullptr;
    holder.labels = nullptr;
    holder.is_emptied = true;
  }
}

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

int TidySubmaps(std::vector<SubmapId> changed, Map& map) {
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  int num_removed = 0;
  for (const SubmapId id : changed) {
    Submap& submap = *map.FindMutable(id);
    submap.PruneBlocks();
    if (submap.blocks().empty() && id != kUnknownSubmap) {
      num_removed += map.Remove(id) ? 1 : 0;
      continue;
    }
    submap.UpdateBoundingSphere();
    RecomputeSubmapLabels(submap);
  }
  return num_removed;
}

}  // namespace dhpmap
