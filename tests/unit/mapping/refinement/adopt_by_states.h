// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_set>

#include "mapping/evidence/submap_labels.h"
#include "mapping/map/map.h"
#include "mapping/refinement/refine_map.h"

namespace dhpmap::testing {

using Positions = std::unordered_set<BlockIndex, BlockIndexHash>;

inline bool SameLayers(const BlockEntry* a, const BlockEntry* b) {
  if (a == nullptr || b == nullptr) return a == b;
  return a->tsdf == b->tsdf && a->labels == b->labels && a->gone == b->gone;
}

/// Block positions at which the submap was written between the two states; either may be null.
inline void AddDifferences(const Submap* before, const Submap* now, Positions& differences) {
  if (now != nullptr) {
    for (const BlockEntry& entry : now->blocks().entries()) {
      if (!SameLayers(before ? before->blocks().Find(entry.index) : nullptr, &entry)) differences.insert(entry.index);
    }
  }
  if (before == nullptr) return;
  for (const BlockEntry& entry : before->blocks().entries()) {
    if (now == nullptr || now->blocks().Find(entry.index) == nullptr) differences.insert(entry.index);
  }
}

inline bool IsOnSameGrid(const Submap& a, const Submap& b) {
  return a.info().T_map_submap.isApprox(b.info().T_map_submap, 0) && a.info().voxel_size_m == b.info().voxel_size_m;
}

inline bool MayBeTakenOver(const Submap& old, const Submap& now) {
  return IsOnSameGrid(old, now) && old.info().edited_revision == now.info().edited_revision &&
         old.info().is_placed == now.info().is_placed && !now.info().is_locked;
}

/// Positions that must stay as they are now.
inline Positions PositionsThatStay(const MapSnapshot& before, const MapSnapshot& refined, const Map& map) {
  Positions stay;
  for (const auto& old : before.submaps()) {
    if (!IsRefined(old->info(), before.info().config)) continue;
    const Submap* now = map.Find(old->id());
    if (now != nullptr && IsOnSameGrid(*old, *now)) AddDifferences(old.get(), now, stay);
    if (now == nullptr || !MayBeTakenOver(*old, *now)) {  // neither what it held nor what it was given has a place
      AddDifferences(old.get(), nullptr, stay);
      AddDifferences(old.get(), refined.Find(old->id()), stay);
    }
  }
  return stay;
}

/// Takes the blocks that refinement changed; returns whether there were any.
inline bool TakeBlocks(const Submap* before, const Submap* refined, const Positions& stay, Submap& now,
                       Positions& deferred) {
  Positions changed;
  AddDifferences(before, refined, changed);
  bool took_any = false;
  for (const BlockIndex index : changed) {
    if (stay.contains(index)) {
      deferred.insert(index);
      continue;
    }
    const BlockEntry* entry = refined ? refined->blocks().Find(index) : nullptr;
    if (entry != nullptr) {
      now.PutBlock(index, entry->tsdf, entry->labels);
      now.PutGone(index, entry->gone);
    } else {
      now.EraseBlock(index);
    }
    took_any = true;
  }
  return took_any;
}

/// What AdoptRefinement should do, told by the two states themselves: the one that the refinement began with, and what
/// it made of it, both kept whole.
inline std::int64_t AdoptByStates(const MapSnapshot& before, const MapSnapshot& refined, Map& map) {
  const Positions stay = PositionsThatStay(before, refined, map);
  Positions deferred;
  for (const auto& old : before.submaps()) {
    const SubmapId id = old->id();
    const Submap* better = refined.Find(id);
    const Submap* now = map.Find(id);
    if (better == old.get() || now == nullptr || !MayBeTakenOver(*old, *now)) continue;
    Submap& submap = *map.FindMutable(id);
    if (!TakeBlocks(old.get(), better, stay, submap, deferred)) continue;
    const bool is_gone =
        submap.blocks().empty() && id != kUnknownSubmap && submap.info().activity == Activity::kInactive;
    if (is_gone) {
      map.Remove(id);
      continue;
    }
    submap.UpdateBoundingSphere();
    RecomputeSubmapLabels(submap);
  }
  return static_cast<std::int64_t>(deferred.size());
}

}  // namespace dhpmap::testing
