// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "storage/store.h"

namespace dhpmap::bench {

inline constexpr char kManyTilesName[] = "many-tiles";
/// Objects of equal size, with ids from 1 on.
inline constexpr int kManyTilesObjects = 4;

/// Makes a map of so many tiles in a store that pages tiles. Each tile has one block with a small piece of a surface,
/// so that rows count and not bytes. Commits some thousand tiles at a time, and keeps no more of them in memory.
Status MakeManyTiles(MapStore& store, std::int64_t num_tiles);

}  // namespace dhpmap::bench
