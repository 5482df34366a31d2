// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mapping/changes/state_marks.h"
#include "mapping/map/map.h"
#include "mapping/voxels/part_identity.h"
#include "mapping/voxels/tile_marks.h"

namespace dhpmap {

// What was written between two states, block by block: the plain reference for DiffTiles, which the store works from.
// One algorithm for a state before and for the marks of one.

struct SubmapChange {
  SubmapId id;
  const Submap* after = nullptr;  ///< null: the submap was removed
  bool is_new = false;
  std::vector<const BlockEntry*> written_tsdf;    ///< of `after`, TSDF layer not the same object as before
  std::vector<const BlockEntry*> written_labels;  ///< of `after`, label layer not the same object as before
  std::vector<const BlockEntry*> written_gone;    ///< of `after`, what was looked through not the same object as before
  std::vector<BlockIndex> erased_tsdf;            ///< blocks whose TSDF layer is gone
  std::vector<BlockIndex> erased_labels;
  std::vector<BlockIndex> erased_gone;
};

/// Compares by identity of the shared parts: costs nothing for submaps that were not written. `before` may be null.
std::vector<SubmapChange> DiffSnapshots(const MapSnapshot* before, const MapSnapshot& after);
std::vector<SubmapChange> DiffSnapshots(const StateMarks& before, const MapSnapshot& after);

// A submap's past, as a state or as marks.
inline const TileEntry* FindTile(const Submap& submap, TileIndex index) { return submap.blocks().FindTile(index); }
inline std::shared_ptr<const TileMarks> FindTile(const SubmapMarks& submap, TileIndex index) {
  return submap.FindTile(index);
}
inline const BlockEntry* FindBlock(const TileEntry& tile, int cell) { return tile.tile->Find(cell); }
inline std::optional<BlockMark> FindBlock(const TileMarks& tile, int cell) { return tile.Find(cell); }
template <typename Visitor>
void VisitTiles(const Submap& submap, Visitor&& visit) {
  for (const TileEntry& tile : submap.blocks().tiles()) visit(tile, tile.tile->entries());
}
template <typename Visitor>
void VisitTiles(const SubmapMarks& submap, Visitor&& visit) {
  for (const auto& tile : submap.tiles()) visit(*tile, tile->blocks());
}
inline TileIndex IndexOf(const TileEntry& tile) { return tile.index; }
inline TileIndex IndexOf(const TileMarks& tile) { return tile.index(); }
inline bool IsSameTile(const TileEntry& old, const TileEntry& now) { return IsSamePart(old.tile, now.tile); }
inline bool IsSameTile(const TileMarks& old, const TileEntry& now) { return old.IsOf(now); }
/// Whether two are known to have the same tiles without a look at them; reads nothing.
inline bool HaveSameUnread(const Submap& old, const Submap& now) { return old.blocks().SharesUnread(now.blocks()); }
inline bool HaveSameUnread(const SubmapMarks& old, const Submap& now) { return old.HaveUnread(now); }

/// Lists what was written of a tile; `before` may be null.
template <typename OldTile>
void DiffTile(const OldTile* before, const BlockTile& after, SubmapChange& change) {
  for (const BlockEntry& entry : after.entries()) {
    using OldBlock = decltype(FindBlock(*before, 0));
    const OldBlock old = before != nullptr ? FindBlock(*before, CellOf(entry.index)) : OldBlock();
    if (old ? !IsSamePart(old->tsdf, entry.tsdf) : entry.tsdf != nullptr) {
      if (entry.tsdf) change.written_tsdf.push_back(&entry);
      else change.erased_tsdf.push_back(entry.index);
    }
    if (old ? !IsSamePart(old->labels, entry.labels) : entry.labels != nullptr) {
      if (entry.labels) change.written_labels.push_back(&entry);
      else change.erased_labels.push_back(entry.index);
    }
    if (old ? !IsSamePart(old->gone, entry.gone) : entry.gone != nullptr) {
      if (entry.gone) change.written_gone.push_back(&entry);
      else change.erased_gone.push_back(entry.index);
    }
  }
}

/// Lists the blocks of a tile that are no longer there; `after` may be null.
template <typename OldBlocks>
void ListErased(const OldBlocks& before, const BlockTile* after, SubmapChange& change) {
  for (const auto& old : before) {
    if (after != nullptr && after->Find(CellOf(old.index)) != nullptr) continue;
    if (WasThere(old.tsdf)) change.erased_tsdf.push_back(old.index);
    if (WasThere(old.labels)) change.erased_labels.push_back(old.index);
    if (WasThere(old.gone)) change.erased_gone.push_back(old.index);
  }
}

/// `before` is a Submap or SubmapMarks, and may be null.
template <typename OldSubmap>
SubmapChange DiffSubmap(const OldSubmap* before, const Submap& after) {
  SubmapChange change{.id = after.id(), .after = &after, .is_new = before == nullptr};
  if (before != nullptr && HaveSameUnread(*before, after)) return change;
  for (const TileEntry& tile : after.blocks().tiles()) {
    using OldTile = decltype(FindTile(*before, tile.index));
    const OldTile old = before != nullptr ? FindTile(*before, tile.index) : OldTile();
    if (!old || !IsSameTile(*old, tile)) DiffTile(std::to_address(old), *tile.tile, change);
  }
  if (before == nullptr) return change;
  VisitTiles(*before, [&](const auto& old, const auto& blocks) {
    const TileEntry* now = after.blocks().FindTile(IndexOf(old));
    if (now == nullptr || !IsSameTile(old, *now)) ListErased(blocks, now ? now->tile.get() : nullptr, change);
  });
  return change;
}

}  // namespace dhpmap
