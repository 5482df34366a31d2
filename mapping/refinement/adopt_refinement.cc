// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/adopt_refinement.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mapping/evidence/submap_labels.h"
#include "mapping/refinement/refine_map.h"
#include "mapping/voxels/tile_marks.h"

namespace dhpmap {
namespace {

using Positions = std::unordered_set<BlockIndex, BlockIndexHash>;

/// Calls visit(BlockEntry) for the blocks of `now` that were written since. `now` may be null.
template <typename Visitor>
void VisitWritten(const SubmapMarks& before, const Submap* now, Visitor&& visit) {
  if (now == nullptr) return;
  for (const TileEntry& tile : now->blocks().tiles()) {
    const auto old = before.FindTile(tile.index);
    if (old != nullptr && old->IsOf(tile)) continue;
    for (const BlockEntry& entry : tile.tile->entries()) {
      const std::optional<BlockMark> mark = old != nullptr ? old->Find(CellOf(entry.index)) : std::nullopt;
      if (!mark || !mark->IsOf(entry)) visit(entry);
    }
  }
}

/// Calls visit(BlockIndex) for the blocks that existed before and are missing in `now`, which may be null.
template <typename Visitor>
void VisitErased(const SubmapMarks& before, const Submap* now, Visitor&& visit) {
  for (const auto& old : before.tiles()) {
    const TileEntry* tile = now != nullptr ? now->blocks().FindTile(old->index()) : nullptr;
    if (tile != nullptr && old->IsOf(*tile)) continue;
    for (const BlockMark& mark : old->blocks()) {
      if (tile == nullptr || tile->tile->Find(CellOf(mark.index)) == nullptr) visit(mark.index);
    }
  }
}

bool IsOnSameGrid(const SubmapInfo& before, const SubmapInfo& now) {
  return before.T_map_submap.isApprox(now.T_map_submap, 0) && before.voxel_size_m == now.voxel_size_m;
}

/// Whether the refinement of a submap can be adopted: it is the same object, unlocked, and not edited since. Frames do
/// not matter; every edit does, and so does its undo.
bool CanTakeOver(const SubmapInfo& before, const SubmapInfo& now) {
  return IsOnSameGrid(before, now) && before.edited_revision == now.edited_revision &&
         before.is_placed == now.is_placed && !now.is_locked;
}

const RefinedSubmap* FindIn(const std::vector<RefinedSubmap>& submaps, SubmapId id) {
  const auto found = std::lower_bound(submaps.begin(), submaps.end(), id,
                                      [](const RefinedSubmap& submap, SubmapId wanted) { return submap.id < wanted; });
  return found != submaps.end() && found->id == id ? &*found : nullptr;
}

/// Positions whose current voxels must not change.
Positions PositionsThatStay(const RefinementOutcome& outcome, const Map& map) {
  Positions stay;
  const auto add = [&stay](BlockIndex index) { stay.insert(index); };
  for (const auto& [id, old] : outcome.before->submaps()) {
    if (!IsRefined(old->info(), outcome.before->info().config)) continue;
    const Submap* now = map.Find(id);
    if (now != nullptr && IsOnSameGrid(old->info(), now->info())) {
      VisitWritten(*old, now, [&](const BlockEntry& entry) { add(entry.index); });
    }
    if (now != nullptr && CanTakeOver(old->info(), now->info())) {
      VisitErased(*old, now, add);
      continue;
    }
    // Removed, locked or edited: its previous and its newly assigned voxels cannot be placed.
    VisitErased(*old, nullptr, add);
    if (const RefinedSubmap* given = FindIn(outcome.written, id)) {
      for (const BlockEntry& entry : given->written) add(entry.index);
    }
  }
  return stay;
}

/// Adopts the blocks that refinement changed; returns whether there were any.
bool TakeBlocks(const RefinedSubmap& refined, const Positions& stay, Submap& now, Positions& deferred) {
  std::unordered_map<BlockIndex, const BlockEntry*, BlockIndexHash> changed;  // null: erased
  for (const BlockEntry& entry : refined.written) changed.emplace(entry.index, &entry);
  for (const BlockIndex index : refined.erased) changed.emplace(index, nullptr);
  bool took_any = false;
  for (const auto& [index, entry] : changed) {
    if (stay.contains(index)) {
      deferred.insert(index);
      continue;
    }
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

}  // namespace

RefinementOutcome OutcomeOf(std::shared_ptr<const StateMarks> before, const MapSnapshot& refined,
                            const RegionPart& part) {
  RefinementOutcome outcome{.before = std::move(before), .written = {}};
  auto now = refined.submaps().begin();
  for (const auto& [id, old] : outcome.before->submaps()) {
    while (now != refined.submaps().end() && (*now)->id() < id) ++now;
    const bool is_there = now != refined.submaps().end() && (*now)->id() == id;
    if (is_there && old->IsOf(*now)) continue;
    const Submap* submap = is_there ? now->get() : nullptr;
    RefinedSubmap& written = outcome.written.emplace_back(RefinedSubmap{.id = id, .written = {}, .erased = {}});
    VisitWritten(*old, submap, [&](const BlockEntry& entry) { written.written.push_back(entry); });
    VisitErased(*old, submap, [&](BlockIndex index) {
      if (part.Has(index)) written.erased.push_back(index);
    });
  }
  return outcome;
}

std::int64_t AdoptRefinement(const RefinementOutcome& outcome, Map& map) {
  const Positions stay = PositionsThatStay(outcome, map);
  Positions deferred;
  for (const RefinedSubmap& refined : outcome.written) {
    const Submap* now = map.Find(refined.id);
    if (now == nullptr || !CanTakeOver(outcome.before->Find(refined.id)->info(), now->info())) continue;
    Submap& submap = *map.FindMutable(refined.id);
    if (!TakeBlocks(refined, stay, submap, deferred)) continue;
    const bool is_gone =
        submap.blocks().empty() && refined.id != kUnknownSubmap && submap.info().activity == Activity::kInactive;
    if (is_gone) {
      map.Remove(refined.id);
      continue;
    }
    submap.UpdateBoundingSphere();
    RecomputeSubmapLabels(submap);
  }
  return static_cast<std::int64_t>(deferred.size());
}

}  // namespace dhpmap
