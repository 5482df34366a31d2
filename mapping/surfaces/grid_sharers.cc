// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/grid_sharers.h"

#include <algorithm>
#include <tuple>

#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

constexpr std::uint32_t kAround = 27;

TileIndex TileBeside(TileIndex tile, std::uint32_t where) {
  const int k = static_cast<int>(where);
  return {tile.x + k % 3 - 1, tile.y + k / 3 % 3 - 1, tile.z + k / 9 - 1};
}

/// Whether it is the same object, even if that has been destroyed.
bool IsObject(const std::weak_ptr<const Submap>& known, const std::shared_ptr<const Submap>& submap) {
  return !known.owner_before(submap) && !submap.owner_before(known);
}

}  // namespace

bool GridSharers::Around::IsAlikeFor(SubmapId submap, const Around& other) const {
  auto a = holders.begin(), b = other.holders.begin();
  const auto skip_own = [submap](auto& at, const auto& end) {
    while (at != end && at->submap == submap) ++at;
  };
  for (;; ++a, ++b) {
    skip_own(a, holders.end());
    skip_own(b, other.holders.end());
    if (a == holders.end() || b == other.holders.end()) return a == holders.end() && b == other.holders.end();
    if (*a != *b) return false;
  }
}

bool GridSharers::Takes(const MapSnapshot& state, const Submap& submap) {
  return !submap.IsAbsent() && IsExclusive(submap.info(), state.info().config);
}

GridSharers::GridSharers(const MapSnapshot& state, const GridSharers* before) : state_(state) {
  std::vector<Change> changes = TakeSubmaps(before);
  if (before != nullptr && changes.empty()) {
    tiles_ = before->tiles_;
    return;
  }
  auto tiles = before == nullptr ? std::make_shared<Tiles>() : std::make_shared<Tiles>(*before->tiles_);
  Apply(std::move(changes), *tiles);
  const auto is_empty = [](const Tile& tile) { return tile.here->empty(); };
  const auto num_empty = std::count_if(tiles->tiles.begin(), tiles->tiles.end(), is_empty);
  if (2 * static_cast<std::size_t>(num_empty) > tiles->tiles.size()) {  // most entries are of removed submaps
    submaps_.clear();
    *tiles = {};
    Apply(TakeSubmaps(nullptr), *tiles);
  }
  tiles_ = std::move(tiles);
}

std::vector<GridSharers::TilePart> GridSharers::PartsOf(const Submap& submap) {
  std::vector<TilePart> parts;
  parts.reserve(submap.blocks().tiles().size());
  for (const TileEntry& entry : submap.blocks().tiles()) parts.push_back({entry.index, entry.tile->part_id()});
  std::sort(parts.begin(), parts.end(), [](const TilePart& a, const TilePart& b) { return a.tile < b.tile; });
  return parts;
}

void GridSharers::AddChanges(SubmapId id, const std::vector<TilePart>& then, const std::vector<TilePart>& now,
                             std::vector<Change>& changes) {
  auto was = then.begin();
  auto is = now.begin();
  while (was != then.end() || is != now.end()) {
    if (is == now.end() || (was != then.end() && was->tile < is->tile)) {
      changes.push_back({(was++)->tile, id, 0});
      continue;
    }
    const bool is_both = was != then.end() && was->tile == is->tile;
    if (!is_both || was->part_id != is->part_id) changes.push_back({is->tile, id, is->part_id});
    if (is_both) ++was;
    ++is;
  }
}

/// The submaps that take part, and their differences from before.
std::vector<GridSharers::Change> GridSharers::TakeSubmaps(const GridSharers* before) {
  static const std::vector<TilePart> kNothing;
  std::vector<Change> changes;
  const std::vector<Sharing> nobody;
  const std::vector<Sharing>& then = before == nullptr ? nobody : before->submaps_;
  auto was = then.begin();
  for (const auto& submap : state_.submaps()) {
    if (!Takes(state_, *submap)) continue;
    for (; was != then.end() && was->id < submap->id(); ++was) AddChanges(was->id, *was->parts, kNothing, changes);
    const bool is_known = was != then.end() && was->id == submap->id();
    if (is_known && IsObject(was->submap, submap)) {
      submaps_.push_back(*was++);
      continue;
    }
    std::vector<TilePart> parts = PartsOf(*submap);
    AddChanges(submap->id(), is_known ? *was->parts : kNothing, parts, changes);
    const bool is_same = is_known && *was->parts == parts;
    submaps_.push_back(
        {.id = submap->id(),
         .submap = submap,
         .parts = is_same ? was->parts : std::make_shared<const std::vector<TilePart>>(std::move(parts))});
    if (is_known) ++was;
  }
  for (; was != then.end(); ++was) AddChanges(was->id, *was->parts, kNothing, changes);
  return changes;
}

/// The surroundings of a tile change if any of the 27 tiles does.
void GridSharers::Apply(std::vector<Change> changes, Tiles& all) {
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return std::tie(a.tile, a.submap) < std::tie(b.tile, b.submap); });
  std::vector<TileIndex> touched;
  for (std::size_t first = 0, end = 0; first < changes.size(); first = end) {
    const TileIndex index = changes[first].tile;
    while (end < changes.size() && changes[end].tile == index) ++end;
    touched.push_back(index);
    std::uint32_t number = all.numbers.Find(index);
    if (number == IndexMap<TileIndex>::kNone) {
      number = static_cast<std::uint32_t>(all.tiles.size());
      all.numbers.Set(index, number);
      all.tiles.push_back(
          {.index = index, .here = std::make_shared<const std::vector<Around::Holder>>(), .around = {}});
    }
    auto here = std::make_shared<std::vector<Around::Holder>>();
    const auto is_changed = [&](SubmapId id) {
      return std::any_of(changes.begin() + static_cast<std::ptrdiff_t>(first),
                         changes.begin() + static_cast<std::ptrdiff_t>(end),
                         [id](const Change& change) { return change.submap == id; });
    };
    for (const Around::Holder& holder : *all.tiles[number].here) {
      if (!is_changed(holder.submap)) here->push_back(holder);
    }
    for (std::size_t i = first; i < end; ++i) {
      if (changes[i].part_id != 0) here->push_back({.submap = changes[i].submap, .part_id = changes[i].part_id});
    }
    std::sort(here->begin(), here->end(),
              [](const Around::Holder& a, const Around::Holder& b) { return a.submap < b.submap; });
    all.tiles[number].here = std::move(here);
  }
  std::vector<bool> is_around(all.tiles.size());
  for (const TileIndex index : touched) {
    for (std::uint32_t where = 0; where < kAround; ++where) {
      const std::uint32_t number = all.numbers.Find(TileBeside(index, where));
      if (number == IndexMap<TileIndex>::kNone || is_around[number]) continue;
      is_around[number] = true;
      Tile& tile = all.tiles[number];
      tile.around = tile.here->empty() ? nullptr : std::make_shared<const Around>(MakeAround(all, tile.index));
    }
  }
}

GridSharers::Around GridSharers::MakeAround(const Tiles& tiles, TileIndex tile) {
  Around around;
  for (std::uint32_t where = 0; where < kAround; ++where) {
    const Tile* beside = tiles.Find(TileBeside(tile, where));
    if (beside == nullptr) continue;
    for (Around::Holder holder : *beside->here) {
      holder.where = where;
      around.holders.push_back(holder);
    }
  }
  return around;
}

const std::shared_ptr<const GridSharers::Around>& GridSharers::AroundOf(TileIndex tile) const {
  static const std::shared_ptr<const Around> kNobody;
  const Tile* found = tiles_->Find(tile);
  return found == nullptr ? kNobody : found->around;
}

std::vector<TilePlace::Sharer> GridSharers::SharersOf(SubmapId submap, TileIndex tile) const {
  std::vector<SubmapId> ids;
  if (const auto& around = AroundOf(tile); around != nullptr) {
    for (const Around::Holder& holder : around->holders) ids.push_back(holder.submap);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<TilePlace::Sharer> sharers;
  for (const SubmapId id : ids) {
    if (id != submap) sharers.push_back({id, FindNeighbourhood(state_.Find(id)->blocks(), tile)});
  }
  return sharers;
}

}  // namespace dhpmap
