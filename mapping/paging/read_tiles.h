// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/spread.h"
#include "mapping/voxels/block_table.h"

namespace dhpmap {

/// Adds the evicted tiles of the table. Throws StatusError.
void AddUnread(const BlockTable& blocks, std::vector<const BlockTile*>& unread);

/// Reads tiles in parallel, ahead of a pass over all of them. They count for the requests of the threads of `spread`
/// (PageReader). Some may be left unread after a `stop`. Throws StatusError.
void ReadTiles(std::span<const BlockTile* const> unread, const Spread& spread, const std::stop_token& stop = {});

}  // namespace dhpmap
