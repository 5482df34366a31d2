// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "mapping/map/map.h"

namespace dhpmap {

/// Bytes of blocks of a submap that a later state of it (null: none) does not share. Linear in the tiles of both, and
/// in the blocks of differing tiles.
std::size_t BlockBytesNotIn(const Submap& before, const Submap* later);

/// Bytes of a state of a map that a later one does not share: blocks, rows and their lists, tables of tiles and of free
/// space.
std::size_t StateBytesNotIn(const MapSnapshot& before, const MapSnapshot& later);

}  // namespace dhpmap
