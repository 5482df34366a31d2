// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "storage/postgres/connection.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/rows/map_head.h"

namespace dhpmap::postgres {

/// How libpq's connections of a server are called, so that others can end them.
std::string ApplicationName(std::int64_t server);

/// What takes a map.
struct Taking {
  MapHead seen;             ///< as it was read: its owner is nobody, dead, or the new one
  std::int64_t beat = -1;   ///< of that owner if it is dead: the beat that it died with
  std::int64_t server = 0;  ///< the new owner
  bool is_damaged = false;  ///< the row has a wrong checksum: no numbers are left
};

enum class Taken { kYes, kChangedMeanwhile, kBlocked };

/// Makes a server the owner of a map that is as it was seen, and leaves the numbers that the last owner has reserved:
/// see MapStore::Reserve. Nothing if the map is not as it was, or its owner has beaten since. kBlocked: the last owner
/// has held the map for half a second, in a transaction that it does not end.
Result<Taken> Take(Connection& connection, const Taking& taking);
/// The epoch with which it was taken.
inline std::int64_t EpochOf(const Taking& taking) { return taking.seen.owner_epoch + 1; }

/// Ends all transactions of a server that is dead: one that was stopped within a pipeline would hold its map for ever.
Status EndConnectionsOf(Connection& connection, std::int64_t server);

}  // namespace dhpmap::postgres
