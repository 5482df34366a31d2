// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/changes/state_delta.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "mapping/voxels/part_identity.h"

namespace dhpmap {
namespace {

/// Of lists of which most is the same. Costs as much as they have, and little if they are equal.
template <typename Entry, typename Less>
ListDelta<Entry> Difference(std::span<const Entry> before, std::span<const Entry> after, const Less& less) {
  ListDelta<Entry> delta;
  if (std::ranges::equal(before, after)) return delta;
  std::vector<Entry> a(before.begin(), before.end()), b(after.begin(), after.end());
  std::sort(a.begin(), a.end(), less);
  std::sort(b.begin(), b.end(), less);
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(delta.before), less);
  std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(delta.after), less);
  return delta;
}

/// The same of lists so short that no order is needed.
template <typename Entry>
ListDelta<Entry> DifferenceOfFew(const std::vector<Entry>& before, const std::vector<Entry>& after) {
  const auto lacks = [](const std::vector<Entry>& list) {
    return [&list](const Entry& entry) { return std::find(list.begin(), list.end(), entry) == list.end(); };
  };
  ListDelta<Entry> delta;
  std::copy_if(before.begin(), before.end(), std::back_inserter(delta.before), lacks(after));
  std::copy_if(after.begin(), after.end(), std::back_inserter(delta.after), lacks(before));
  return delta;
}

bool IsLess(const ObjectPair& a, const ObjectPair& b) {
  return std::tie(a.first, a.second, a.verdict, a.evidence) < std::tie(b.first, b.second, b.verdict, b.evidence);
}

bool IsLessMerged(const MergedId& a, const MergedId& b) {
  return std::tie(a.merged, a.into) < std::tie(b.merged, b.into);
}

/// `a` may be null.
bool IsSameRow(const Submap* a, const Submap& b) { return a != nullptr && a->part_id() == b.part_id(); }

std::optional<SubmapRowState> RowOf(const Submap* submap) {
  if (submap == nullptr) return std::nullopt;
  return SubmapRowState{submap->info(), submap->bounding_sphere()};
}

/// The layers of which the tiles do not have the very same blocks.
BlockLayers DifferingLayers(const BlockTile* before, const BlockTile* after) {
  BlockLayers differs{};
  const BlockEntry none;
  for (int cell = 0; cell < kTileBlocks; ++cell) {
    const BlockEntry* a = before != nullptr ? before->Find(cell) : nullptr;
    const BlockEntry* b = after != nullptr ? after->Find(cell) : nullptr;
    ForEachLayer(
        [&differs](BlockLayer layer, const auto& x, const auto& y) {
          if (!IsSamePart(x, y)) differs[static_cast<std::size_t>(layer)] = true;
        },
        a != nullptr ? *a : none, b != nullptr ? *b : none);
  }
  return differs;
}

/// What a tile has of some layers; null if that is nothing.
std::shared_ptr<const BlockTile> Part(const BlockTile* tile, const BlockLayers& layers) {
  if (tile == nullptr) return nullptr;
  BlockTable table;
  const TileIndex index = TileOf(tile->entries().front().index);
  table.PutLayers(index, tile, layers);
  return table.empty() ? nullptr : table.FindTile(index)->tile;
}

std::vector<TileDelta> TileDeltasOf(const Submap* before, const Submap* after) {
  std::vector<TileDelta> tiles;
  if (before != nullptr && after != nullptr && before->blocks().SharesUnread(after->blocks())) return tiles;
  std::set<TileIndex> indices;
  for (const Submap* side : {before, after}) {
    if (side == nullptr) continue;
    for (const TileEntry& entry : side->blocks().tiles()) indices.insert(entry.index);
  }
  for (const TileIndex index : indices) {
    const TileEntry* a = before != nullptr ? before->blocks().FindTile(index) : nullptr;
    const TileEntry* b = after != nullptr ? after->blocks().FindTile(index) : nullptr;
    if (a != nullptr && b != nullptr && IsSamePart(a->tile, b->tile)) continue;
    const BlockTile* x = a != nullptr ? a->tile.get() : nullptr;
    const BlockTile* y = b != nullptr ? b->tile.get() : nullptr;
    const BlockLayers differs = DifferingLayers(x, y);
    if (differs == BlockLayers{}) continue;
    tiles.push_back({.index = index, .differs = differs, .before = Part(x, differs), .after = Part(y, differs)});
  }
  return tiles;
}

}  // namespace

StateDelta DiffRows(const MapSnapshot& before, const MapSnapshot& after) {
  StateDelta delta;
  std::set<SubmapId> ids;
  for (const auto& submap : before.submaps()) {
    if (!IsSameRow(after.Find(submap->id()), *submap)) ids.insert(submap->id());
  }
  for (const auto& submap : after.submaps()) {
    if (!IsSameRow(before.Find(submap->id()), *submap)) ids.insert(submap->id());
  }
  for (const SubmapId id : ids) {
    delta.submaps.push_back({.id = id, .before = RowOf(before.Find(id)), .after = RowOf(after.Find(id)), .tiles = {}});
  }
  delta.pairs = Difference<ObjectPair>(before.info().pairs.pairs(), after.info().pairs.pairs(), IsLess);
  if (!(before.info().merged == after.info().merged)) {  // which asks first whether it is the very same list
    delta.merged = Difference<MergedId>(before.info().merged.list(), after.info().merged.list(), IsLessMerged);
  }
  delta.kept_clear = DifferenceOfFew(before.info().kept_clear.list(), after.info().kept_clear.list());
  if (before.info().display_name != after.info().display_name) {
    delta.display_name = {{before.info().display_name}, {after.info().display_name}};
  }
  return delta;
}

void AddTiles(const MapSnapshot& before, const MapSnapshot& after, StateDelta& delta) {
  for (SubmapDelta& submap : delta.submaps) submap.tiles = TileDeltasOf(before.Find(submap.id), after.Find(submap.id));
  std::map<TileIndex, VacatedDelta> vacated;
  for (const FreeTileEntry& entry : before.vacated()->tiles()) vacated[entry.index].before = entry.tile;
  for (const FreeTileEntry& entry : after.vacated()->tiles()) vacated[entry.index].after = entry.tile;
  for (auto& [index, tile] : vacated) {
    if (tile.before == tile.after) continue;
    tile.index = index;
    delta.vacated.push_back(std::move(tile));
  }
}

}  // namespace dhpmap
