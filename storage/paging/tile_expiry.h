// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "storage/sqlite/database.h"

namespace dhpmap {

/// Owner of a tile when its state was read: keys of rows, which are never reused.
struct TileOwner {
  std::int64_t map_key = 0;
  std::int64_t submap_key = 0;
};

/// Whether the store has deleted a missing blob because the map has changed since. False if it may be lost instead: a
/// row still refers to it, or the map's submaps or this one's tiles do not match their rows. Scans all rows of tiles,
/// so only for calls that have failed already.
Result<bool> IsGivenUp(sqlite::Database& database, const TileOwner& owner, std::int64_t blob_key);

/// Whether a submap has other tiles than in the state that was read because the map has changed since. False if rows
/// may be lost instead: the map's submaps or this one's tiles do not match their rows. Within the caller's transaction.
Result<bool> HasGoneOn(sqlite::Database& database, const TileOwner& owner);

}  // namespace dhpmap
