// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/state_marks.h"

#include <algorithm>
#include <utility>

#include "mapping/map/diff_submap.h"

namespace dhpmap {
namespace {

BlockMark MarkBlock(const BlockEntry& block) {
  BlockMark mark;
  mark.index = block.index;
  ForEachLayer([](BlockLayer, const auto& layer, auto& name) { name = PartIdOf(layer); }, block, mark);
  return mark;
}

BlockMark MarkOnPage(const TilePage& page, int cell) {
  BlockMark mark;
  mark.index = BlockIn(page.tile().index, cell);
  ForEachLayer([&](BlockLayer layer, auto& name) { name = page.PartIdOf(layer, cell); }, mark);
  return mark;
}

std::shared_ptr<const TileMarks> MarkTile(const TileEntry& entry) {
  auto marks = std::make_shared<TileMarks>();
  marks->index = entry.index;
  marks->tile = entry.tile->part_id();
  marks->blocks.reserve(entry.tile->size());
  if (const TilePage* page = entry.tile->page().get()) {  // known without reading it
    for (int cell = 0; cell < kTileBlocks; ++cell) {
      if ((page->cells() >> cell & 1u) != 0) marks->blocks.push_back(MarkOnPage(*page, cell));
    }
    return marks;
  }
  for (const BlockEntry& block : entry.tile->entries()) marks->blocks.push_back(MarkBlock(block));
  return marks;
}

/// Of a tile as it was in `before`, but for the blocks that `is_in_part` names: those are as in `now`, which may be
/// null.
std::shared_ptr<const TileMarks> MarkPart(const std::shared_ptr<const TileMarks>& before, const BlockTile* now,
                                          const std::function<bool(BlockIndex)>& is_in_part) {
  auto marks = std::make_shared<TileMarks>();
  marks->index = before->index;
  bool is_same = true;
  for (int cell = 0; cell < kTileBlocks; ++cell) {
    const BlockMark* old = before->Find(cell);
    const BlockEntry* entry = now != nullptr ? now->Find(cell) : nullptr;
    if (old == nullptr && entry == nullptr) continue;
    const bool is_new = is_in_part(BlockIn(before->index, cell));
    is_same = is_same && (!is_new || (old != nullptr && entry != nullptr && old->IsOf(*entry)));
    if (is_new && entry != nullptr) marks->blocks.push_back(MarkBlock(*entry));
    else if (!is_new && old != nullptr) marks->blocks.push_back(*old);
  }
  return is_same ? before : marks;
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
    const BlockMark* old = before != nullptr ? before->Find(CellOf(entry.index)) : nullptr;
    CompareBlock(old != nullptr ? *old : kNoBlock, entry, change);
  }
  for (const BlockMark& old : before != nullptr ? std::span(before->blocks) : std::span<const BlockMark>()) {
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
  for (const TileEntry& entry : after.blocks().tiles()) {
    const TileMarks* old = before != nullptr ? before->FindTile(entry.index) : nullptr;
    if (old == nullptr || !old->IsOf(entry)) compare(entry.index, old, entry.tile);
  }
  if (before == nullptr) return change;
  for (const auto& old : before->tiles()) {
    if (after.blocks().FindTile(old->index) == nullptr) compare(old->index, old.get(), nullptr);
  }
  return change;
}

}  // namespace

bool BlockMark::IsOf(const BlockEntry& entry) const {
  bool is_same = true;
  ForEachLayer(
      [&is_same](BlockLayer, const auto& name, const auto& layer) { is_same = is_same && IsSamePart(name, layer); },
      *this, entry);
  return is_same;
}

bool TileMarks::IsOf(const TileEntry& entry) const { return tile == entry.tile->part_id(); }

const BlockMark* TileMarks::Find(int cell) const {
  const auto found = std::lower_bound(blocks.begin(), blocks.end(), cell,
                                      [](const BlockMark& mark, int wanted) { return CellOf(mark.index) < wanted; });
  return found != blocks.end() && CellOf(found->index) == cell ? &*found : nullptr;
}

SubmapMarks::SubmapMarks(const std::shared_ptr<const Submap>& submap, const SubmapMarks* before)
    : info_(submap->info()), sphere_in_map_(submap->BoundingSphereInMap()), submap_(submap->part_id()) {
  const std::span<const TileEntry> tiles = submap->blocks().tiles();
  tiles_.reserve(tiles.size());
  numbers_.Reserve(tiles.size());
  for (const TileEntry& entry : tiles) {
    const std::uint32_t old = before != nullptr ? before->numbers_.Find(entry.index) : IndexMap<TileIndex>::kNone;
    const bool is_same = old != IndexMap<TileIndex>::kNone && before->tiles_[old]->IsOf(entry);
    Add(is_same ? before->tiles_[old] : MarkTile(entry));
  }
}

SubmapMarks::SubmapMarks(const SubmapMarks& before, const Submap& part,
                         const std::function<bool(BlockIndex)>& is_in_part)
    : info_(before.info_), sphere_in_map_(before.sphere_in_map_) {
  for (const auto& tile : before.tiles_) {
    const TileEntry* now = part.blocks().FindTile(tile->index);
    const auto marks = MarkPart(tile, now != nullptr ? now->tile.get() : nullptr, is_in_part);
    if (!marks->blocks.empty()) Add(marks);
  }
  for (const TileEntry& entry : part.blocks().tiles()) {
    if (before.FindTile(entry.index) == nullptr) Add(MarkTile(entry));
  }
}

void SubmapMarks::Add(std::shared_ptr<const TileMarks> tile) {
  numbers_.Set(tile->index, static_cast<std::uint32_t>(tiles_.size()));
  tiles_.push_back(std::move(tile));
}

bool SubmapMarks::IsOf(const std::shared_ptr<const Submap>& submap) const { return submap_ == submap->part_id(); }

const TileMarks* SubmapMarks::FindTile(TileIndex index) const {
  const std::uint32_t number = numbers_.Find(index);
  return number == IndexMap<TileIndex>::kNone ? nullptr : tiles_[number].get();
}

const BlockMark* SubmapMarks::Find(BlockIndex index) const {
  const TileMarks* tile = FindTile(TileOf(index));
  return tile != nullptr ? tile->Find(CellOf(index)) : nullptr;
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
  const std::span<const TileEntry> tiles = copy.blocks().tiles();
  if (tiles.empty()) return nullptr;
  const TileEntry& probe = tiles[tiles.size() / 2];
  for (const auto& [id, marks] : submaps_) {
    const TileMarks* tile = marks->FindTile(probe.index);
    if (tile != nullptr && tile->IsOf(probe)) return marks.get();
  }
  return nullptr;
}

bool StateMarks::Has(SubmapId submap, const BlockEntry& entry) const {
  const SubmapMarks* marks = Find(submap);
  const BlockMark* mark = marks != nullptr ? marks->Find(entry.index) : nullptr;
  return mark != nullptr && mark->IsOf(entry);
}

std::vector<SubmapChange> DiffSnapshots(const StateMarks& before, const MapSnapshot& after) {
  std::vector<SubmapChange> changes;
  for (const auto& submap : after.submaps()) {
    const SubmapMarks* old = before.Find(submap->id());
    if (old == nullptr || !old->IsOf(submap)) changes.push_back(DiffSubmap(old, *submap));
  }
  for (const auto& [id, old] : before.submaps()) {
    if (after.Find(id) == nullptr) changes.push_back({.id = id});
  }
  return changes;
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
