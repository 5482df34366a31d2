// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "mapping/map/map.h"
#include "mapping/map/state_marks.h"

namespace dhpmap {

// What was written to a submap since a state, or since the marks of a state were made: one algorithm for both.

// See PartId; 0 where there is no part.
inline std::uint64_t PartIdOf(const BlockTile* tile) { return tile != nullptr ? tile->part_id() : 0; }
template <typename Layer>
std::uint64_t PartIdOf(const Layer* layer) {
  return layer != nullptr ? layer->part_id.value() : 0;
}
inline std::uint64_t PartIdOf(std::uint64_t name) { return name; }
template <typename Part>
std::uint64_t PartIdOf(const std::shared_ptr<const Part>& part) {
  return PartIdOf(part.get());
}

/// Each is a part, or the name of one.
template <typename Old, typename Now>
bool IsSamePart(const Old& old, const Now& now) {
  return PartIdOf(old) == PartIdOf(now);
}

/// Of what a name is kept of by a pointer: nothing else gets it while that is left.
template <typename Part>
bool IsSameObject(const std::weak_ptr<const Part>& old, const std::shared_ptr<const Part>& now) {
  return !old.owner_before(now) && !now.owner_before(old);
}

/// Whether there was a part at all; it need not be alive.
template <typename Part>
bool WasThere(const Part& old) {
  return PartIdOf(old) != 0;
}

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
