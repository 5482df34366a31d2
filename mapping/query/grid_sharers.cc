// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/grid_sharers.h"

#include <algorithm>

#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

constexpr std::uint32_t kAround = 27;

TileIndex TileBeside(TileIndex tile, std::uint32_t where) {
  const int k = static_cast<int>(where);
  return {tile.x + k % 3 - 1, tile.y + k / 3 % 3 - 1, tile.z + k / 9 - 1};
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
  for (const auto& submap : state.submaps()) {
    if (!Takes(state, *submap)) continue;
    for (const TileEntry& entry : submap->blocks().tiles()) {
      std::uint32_t number = numbers_.Find(entry.index);
      if (number == IndexMap<TileIndex>::kNone) {
        number = static_cast<std::uint32_t>(tiles_.size());
        numbers_.Set(entry.index, number);
        tiles_.push_back({.index = entry.index, .here = {}, .around = nullptr});
      }
      tiles_[number].here.push_back({.submap = submap->id(), .part_id = entry.tile->part_id()});
    }
  }
  const auto is_as_before = [&](TileIndex index) {
    const Tile *now = Find(index), *then = before->Find(index);
    if (now == nullptr || then == nullptr) return now == then;
    return now->here == then->here;
  };
  // A tile is as it was if all around it are: a look at each once, then at what was found.
  std::vector<bool> is_changed(tiles_.size(), before == nullptr);
  const auto mark_around = [&](TileIndex index) {
    for (std::uint32_t where = 0; where < kAround; ++where) {
      const std::uint32_t number = numbers_.Find(TileBeside(index, where));
      if (number != IndexMap<TileIndex>::kNone) is_changed[number] = true;
    }
  };
  if (before != nullptr) {
    for (const Tile& tile : tiles_) {
      if (!is_as_before(tile.index)) mark_around(tile.index);
    }
    for (const Tile& tile : before->tiles_) {
      if (Find(tile.index) == nullptr) mark_around(tile.index);
    }
  }
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    Tile& tile = tiles_[i];
    tile.around =
        is_changed[i] ? std::make_shared<const Around>(MakeAround(tile.index)) : before->Find(tile.index)->around;
  }
}

GridSharers::Around GridSharers::MakeAround(TileIndex tile) const {
  Around around;
  for (std::uint32_t where = 0; where < kAround; ++where) {
    const Tile* beside = Find(TileBeside(tile, where));
    if (beside == nullptr) continue;
    for (Around::Holder holder : beside->here) {
      holder.where = where;
      around.holders.push_back(holder);
    }
  }
  return around;
}

const std::shared_ptr<const GridSharers::Around>& GridSharers::AroundOf(TileIndex tile) const {
  static const std::shared_ptr<const Around> kNobody;
  const Tile* found = Find(tile);
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
