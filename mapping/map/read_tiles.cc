// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/read_tiles.h"

#include <algorithm>

#include "mapping/map/page_reader.h"

namespace dhpmap {

void AddUnread(const BlockTable& blocks, std::vector<const BlockTile*>& unread) {
  for (const TileEntry& entry : blocks.tiles()) {
    if (!entry.tile->IsRead()) unread.push_back(entry.tile.get());
  }
}

void ReadTiles(std::span<const BlockTile* const> unread, const Spread& spread, const std::stop_token& stop) {
  constexpr std::size_t kAtOnce = 64;
  PageHold* const hold = PageReader::Current();
  for (std::size_t begin = 0; begin < unread.size() && !stop.stop_requested(); begin += kAtOnce) {
    spread(std::min(kAtOnce, unread.size() - begin), [&](std::size_t i) {
      if (stop.stop_requested()) return;
      const PageReader reading(hold);
      (void)unread[begin + i]->entries();
    });
  }
}

}  // namespace dhpmap
