// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/changes/state_marks.h"

#include <algorithm>
#include <utility>

#include "mapping/voxels/part_identity.h"

namespace dhpmap {
namespace {

BlockMark MarkBlock(const BlockEntry& block) {
  BlockMark mark;
  mark.index = block.index;
  ForEachLayer([](BlockLayer, const auto& layer, auto& name) { name = PartIdOf(layer); }, block, mark);
  return mark;
}

/// Of a tile as it was in `before`, but for the blocks that `is_in_part` names: those are as in `now`, which may be
/// null.
std::shared_ptr<const TileMarks> MarkPart(const std::shared_ptr<const TileMarks>& before, const BlockTile* now,
                                          const std::function<bool(BlockIndex)>& is_in_part) {
  std::vector<BlockMark> blocks;
  blocks.reserve(kTileBlocks);
  bool is_same = true;
  for (int cell = 0; cell < kTileBlocks; ++cell) {
    const std::optional<BlockMark> old = before->Find(cell);
    const BlockEntry* entry = now != nullptr ? now->Find(cell) : nullptr;
    if (!old && entry == nullptr) continue;
    const bool is_new = is_in_part(BlockIn(before->index(), cell));
    is_same = is_same && (!is_new || (old && entry != nullptr && old->IsOf(*entry)));
    if (is_new && entry != nullptr) blocks.push_back(MarkBlock(*entry));
    else if (!is_new && old) blocks.push_back(*old);
  }
  return is_same ? before : std::make_shared<const TileMarks>(before->index(), blocks);
}

std::shared_ptr<const SubmapMarks> MarkSubmap(const std::shared_ptr<const Submap>& submap, const StateMarks* before) {
  if (before == nullptr) return std::make_shared<const SubmapMarks>(submap, nullptr);
  const auto old = before->submaps().find(submap->id());
  if (old == before->submaps().end()) {
    return std::make_shared<const SubmapMarks>(submap, before->FindOriginalOf(*submap));
  }
  if (old->second->IsOf(submap)) return old->second;
  return std::make_shared<const SubmapMarks>(submap, old->second.get());
}

const BlockMark kNoBlock{};

void CompareBlock(const BlockMark& before, const BlockEntry& after, TileChange& change) {
  ForEachLayer(
      [&change](BlockLayer layer, const auto& old, const auto& now) {
        const auto i = static_cast<std::size_t>(layer);
        change.num_before[i] += WasThere(old);
        change.num_after[i] += now != nullptr;
        change.is_written[i] = change.is_written[i] || !IsSamePart(old, now);
      },
      before, after);
}

/// Either may be null.
TileChange CompareTile(TileIndex index, const TileMarks* before, const std::shared_ptr<const BlockTile>& after) {
  TileChange change{.index = index, .after = after, .is_written = {}, .num_before = {}, .num_after = {}};
  for (const BlockEntry& entry : after != nullptr ? after->entries() : std::span<const BlockEntry>()) {
    const std::optional<BlockMark> old = before != nullptr ? before->Find(CellOf(entry.index)) : std::nullopt;
    CompareBlock(old.value_or(kNoBlock), entry, change);
  }
  for (const BlockMark& old : before != nullptr ? before->blocks() : std::vector<BlockMark>()) {
    if (after == nullptr || after->Find(CellOf(old.index)) == nullptr) CompareBlock(old, BlockEntry(), change);
  }
  return change;
}

/// `before` may be null.
SubmapTileChange DiffTilesOf(const SubmapMarks* before, const Submap& after) {
  SubmapTileChange change{.id = after.id(), .after = &after};
  const auto compare = [&change](TileIndex index, const TileMarks* old, const std::shared_ptr<const BlockTile>& now) {
    TileChange tile = CompareTile(index, old, now);
    // One that holds what was there as another object has yet to learn under which keys that is stored.
    const bool holds_any = std::any_of(tile.num_after.begin(), tile.num_after.end(), [](auto num) { return num > 0; });
    const bool is_written = std::find(tile.is_written.begin(), tile.is_written.end(), true) != tile.is_written.end();
    if (!is_written && !holds_any) return;
    change.tiles.push_back(std::move(tile));
  };
  if (before != nullptr && before->HaveUnread(after)) return change;
  for (const TileEntry& entry : after.blocks().tiles()) {
    const auto old = before != nullptr ? before->FindTile(entry.index) : nullptr;
    if (old == nullptr || !old->IsOf(entry)) compare(entry.index, old.get(), entry.tile);
  }
  if (before == nullptr) return change;
  for (const auto& old : before->tiles()) {
    if (after.blocks().FindTile(old->index()) == nullptr) compare(old->index(), old.get(), nullptr);
  }
  return change;
}

}  // namespace

SubmapMarks::SubmapMarks(const std::shared_ptr<const Submap>& submap, const SubmapMarks* before)
    : info_(submap->info()), sphere_in_map_(submap->BoundingSphereInMap()), submap_(submap->part_id()) {
  if (const auto& unread = submap->blocks().unread()) {
    unread_ = unread->marks();
    return;
  }
  const std::span<const TileEntry> tiles = submap->blocks().tiles();
  table_.Reserve(tiles.size());
  for (const TileEntry& entry : tiles) {
    auto old = before != nullptr ? before->FindTile(entry.index) : nullptr;
    const bool is_same = old != nullptr && old->IsOf(entry);
    table_.Add(is_same ? std::move(old) : std::make_shared<const TileMarks>(entry));
  }
}

SubmapMarks::SubmapMarks(const SubmapMarks& before, const Submap& part,
                         const std::function<bool(BlockIndex)>& is_in_part)
    : info_(before.info_), sphere_in_map_(before.sphere_in_map_) {
  for (const auto& tile : before.tiles()) {
    const TileEntry* now = part.blocks().FindTile(tile->index());
    auto marks = MarkPart(tile, now != nullptr ? now->tile.get() : nullptr, is_in_part);
    if (!marks->empty()) table_.Add(std::move(marks));
  }
  for (const TileEntry& entry : part.blocks().tiles()) {
    if (before.FindTile(entry.index) == nullptr) table_.Add(std::make_shared<const TileMarks>(entry));
  }
}

bool SubmapMarks::IsOf(const std::shared_ptr<const Submap>& submap) const { return submap_ == submap->part_id(); }

std::optional<BlockMark> SubmapMarks::Find(BlockIndex index) const {
  const auto tile = FindTile(TileOf(index));
  return tile != nullptr ? tile->Find(CellOf(index)) : std::nullopt;
}

bool SubmapMarks::HaveUnread(const Submap& submap) const {
  const auto& unread = submap.blocks().unread();
  return unread_ != nullptr && unread != nullptr && unread->marks() == unread_;
}

bool SubmapMarks::HaveTile(const TileEntry& tile) const {
  const TileMarkTable* const table = unread_ == nullptr ? &table_ : unread_->IfRead();
  const auto found = table != nullptr ? table->Find(tile.index) : nullptr;
  return found != nullptr && found->IsOf(tile);
}

StateMarks::StateMarks(const MapSnapshot& state, const StateMarks* before, bool lacks_left)
    : info_(state.info()),
      free_space_(MarksOf(*state.free_space())),
      vacated_(MarksOf(lacks_left ? *state.noted_vacated() : *state.vacated())),
      lacks_left_(lacks_left && state.leaving()) {
  for (const auto& submap : state.submaps()) submaps_[submap->id()] = MarkSubmap(submap, before);
}

StateMarks::StateMarks(const StateMarks& before, const MapSnapshot& part,
                       const std::function<bool(BlockIndex)>& is_in_part)
    : info_(before.info_), free_space_(before.free_space_), vacated_(before.vacated_) {
  for (const auto& submap : part.submaps()) {
    const auto old = before.submaps_.find(submap->id());
    if (old == before.submaps_.end()) submaps_[submap->id()] = std::make_shared<const SubmapMarks>(submap, nullptr);
    else submaps_[submap->id()] = std::make_shared<const SubmapMarks>(*old->second, *submap, is_in_part);
  }
}

StateMarks::LayerMarks StateMarks::MarksOf(const FreeSpace& layer) {
  LayerMarks marks;
  marks.reserve(layer.tiles().size());
  for (const FreeTileEntry& entry : layer.tiles()) marks.push_back({entry.index, entry.tile});
  std::sort(marks.begin(), marks.end(), [](const FreeTileMark& a, const FreeTileMark& b) { return a.index < b.index; });
  return marks;
}

const SubmapMarks* StateMarks::Find(SubmapId id) const {
  const auto found = submaps_.find(id);
  return found != submaps_.end() ? found->second.get() : nullptr;
}

const SubmapMarks* StateMarks::FindOriginalOf(const Submap& copy) const {
  const bool is_unread = copy.blocks().unread() != nullptr;
  const std::span<const TileEntry> tiles = copy.blocks().tiles_if_read();
  const TileEntry* const probe = tiles.empty() ? nullptr : &tiles[tiles.size() / 2];
  for (const auto& [id, marks] : submaps_) {
    if (is_unread && marks->HaveUnread(copy)) return marks.get();
    if (probe != nullptr && marks->HaveTile(*probe)) return marks.get();
  }
  return nullptr;
}

bool StateMarks::Has(SubmapId submap, const BlockEntry& entry) const {
  const SubmapMarks* marks = Find(submap);
  const std::optional<BlockMark> mark = marks != nullptr ? marks->Find(entry.index) : std::nullopt;
  return mark && mark->IsOf(entry);
}

std::vector<SubmapTileChange> DiffTiles(const StateMarks& before, const MapSnapshot& after) {
  std::vector<SubmapTileChange> changes;
  for (const auto& submap : after.submaps()) {
    const SubmapMarks* old = before.Find(submap->id());
    if (old != nullptr && old->IsOf(submap)) continue;
    const SubmapMarks* original = old == nullptr ? before.FindOriginalOf(*submap) : nullptr;
    SubmapTileChange& change = changes.emplace_back(DiffTilesOf(old != nullptr ? old : original, *submap));
    change.is_new = old == nullptr;
    if (original != nullptr) change.copy_of = original->info().id;
  }
  for (const auto& [id, old] : before.submaps()) {
    if (after.Find(id) == nullptr) changes.push_back({.id = id});
  }
  return changes;
}

FreeSpaceChange StateMarks::Diff(const LayerMarks& before, const FreeSpace& after) {
  FreeSpaceChange change;
  const auto find = [&before](TileIndex index) {
    const auto found = std::lower_bound(before.begin(), before.end(), index,
                                        [](const auto& mark, TileIndex wanted) { return mark.index < wanted; });
    return found != before.end() && found->index == index ? &*found : nullptr;
  };
  for (const FreeTileEntry& entry : after.tiles()) {
    const auto* old = find(entry.index);
    if (old == nullptr || !IsSameObject(old->tile, entry.tile)) change.written.push_back(&entry);
  }
  for (const FreeTileMark& old : before) {
    if (after.FindEntry(old.index) == nullptr) change.erased.push_back(old.index);
  }
  return change;
}

FreeSpaceChange DiffFreeSpace(const StateMarks& before, const FreeSpace& after) {
  return StateMarks::Diff(before.free_space_, after);
}

FreeSpaceChange DiffVacated(const StateMarks& before, const FreeSpace& after) {
  return StateMarks::Diff(before.vacated_, after);
}

}  // namespace dhpmap
