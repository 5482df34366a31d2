// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/read_tiles.h"

namespace dhpmap {

void AddUnread(const BlockTable& blocks, std::vector<const BlockTile*>& unread) {
  for (const TileEntry& entry : blocks.tiles()) {
    if (!entry.tile->IsRead()) unread.push_back(entry.tile.get());
  }
}

void ReadTiles(std::span<const BlockTile* const> unread, const Spread& spread, const std::stop_token& stop) {
  InParts(unread.size(), spread, stop, [unread](std::size_t i) { (void)unread[i]->entries(); });
}

}  // namespace dhpmap
