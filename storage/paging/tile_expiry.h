// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "storage/sqlite/database.h"

namespace dhpmap {

/// Whose tile it was when its state was read: keys of rows, which are never given out again.
struct TileOwner {
  std::int64_t map_key = 0;
  std::int64_t submap_key = 0;
};

/// ABORTED, reason SNAPSHOT_EXPIRED. `what`: the subject of the sentence.
Status Expired(const std::string& what);

/// Of a blob that is not there: whether the store has given it up because the map went on without it. False where it
/// may as well be lost: a row still refers to it, or the map's submaps or this one's tiles are not those that their
/// rows speak of. Looks at all rows of tiles there are: for who has failed already.
Result<bool> IsGivenUp(sqlite::Database& database, const TileOwner& owner, std::int64_t blob_key);

/// Of a submap that has other tiles than when its state was read: whether the map has gone on without that state. False
/// where rows may as well be lost: the map's submaps or this one's tiles are not those that their rows speak of. Within
/// the caller's transaction.
Result<bool> HasGoneOn(sqlite::Database& database, const TileOwner& owner);

}  // namespace dhpmap
