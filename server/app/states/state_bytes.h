// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "mapping/map/map.h"

namespace dhpmap {

/// Bytes of blocks that a submap has and a later state of it (null: there is none) does not share. Costs in proportion
/// to the tiles of both, and to the blocks of tiles that differ.
std::size_t BlockBytesNotIn(const Submap& before, const Submap* later);

/// Bytes that a state of a map has and a later one does not share: blocks, rows and their lists, tables of tiles and of
/// free space.
std::size_t StateBytesNotIn(const MapSnapshot& before, const MapSnapshot& later);

}  // namespace dhpmap
