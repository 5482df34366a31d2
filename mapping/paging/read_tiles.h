// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/spread.h"
#include "mapping/voxels/block_table.h"

namespace dhpmap {

/// Adds the tiles of the table whose blocks are on the disk. Throws StatusError.
void AddUnread(const BlockTable& blocks, std::vector<const BlockTile*>& unread);

/// Reads them, several at a time, for who is about to go through all of them: one after the other they would be waited
/// for. They count for whose requests the threads of `spread` read (PageReader). After a `stop` that is requested
/// meanwhile some are left. Throws StatusError.
void ReadTiles(std::span<const BlockTile* const> unread, const Spread& spread, const std::stop_token& stop = {});

}  // namespace dhpmap
