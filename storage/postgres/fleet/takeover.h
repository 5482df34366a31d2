// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "storage/postgres/connection.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/rows/map_head.h"

namespace dhpmap::postgres {

/// The application name of a server's connections, by which others can end them.
std::string ApplicationName(std::int64_t server);

/// The takeover of a map.
struct Taking {
  MapHead seen;             ///< the row as read: its owner is none, dead, or the new one
  std::int64_t beat = -1;   ///< the last beat of that owner, if it is dead
  std::int64_t server = 0;  ///< the new owner
  bool is_damaged = false;  ///< the row has a wrong checksum: no numbers are skipped
};

enum class Taken { kYes, kChangedMeanwhile, kBlocked };

/// Makes a server the owner of a map, and skips the numbers that the last owner has reserved (MapStore::Reserve).
/// kChangedMeanwhile: the map's row has changed, or its owner has beaten since. kBlocked: a transaction of the last
/// owner has held the map for half a second.
Result<Taken> Take(Connection& connection, const Taking& taking);
/// The epoch of the new owner.
inline std::int64_t EpochOf(const Taking& taking) { return taking.seen.owner_epoch + 1; }

/// Ends all connections of a dead server. One that was stopped within a pipeline would otherwise hold its map for ever.
Status EndConnectionsOf(Connection& connection, std::int64_t server);

}  // namespace dhpmap::postgres
