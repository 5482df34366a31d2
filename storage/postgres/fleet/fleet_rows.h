// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/fleet.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/fleet/peers.h"

namespace dhpmap::postgres {

// The rows by which servers know each other. Each call is one round trip with autocommit.

/// The step of the schema that has the columns of FollowingState.
inline constexpr std::int64_t kFollowingStep = 6;

/// The rows and the newest step of the schema, as they were right after a beat.
struct BeatAnswer {
  std::vector<ServerRow> rows;
  std::int64_t schema = 0;
};
/// Writes this process's row with a new beat. `following`: none if the schema has no columns for it.
/// FAILED_PRECONDITION, reason NEWER_SCHEMA, if this version does not know the database's schema.
Result<BeatAnswer> WriteBeat(Connection& connection, const ServerRow& me,
                             const std::optional<FollowingState>& following);
/// All rows.
Result<std::vector<ServerRow>> ReadRows(Connection& connection);
/// The epochs of all maps that a server owns, by map_key.
Result<std::map<std::int64_t, std::int64_t>> ReadEpochs(Connection& connection, std::int64_t server);

/// A row, and how many maps its server owns. Owners without a row have a beat of -1.
struct ServerWithMaps {
  ServerRow row;
  std::int64_t num_maps = 0;
  std::optional<FollowingState> following;
};
/// `has_following`: the schema has columns for it.
Result<std::vector<ServerWithMaps>> ReadServers(Connection& connection, bool has_following);

/// A map, its owner and epoch.
struct OwnerRow {
  std::string map;
  std::int64_t server = 0;
  std::int64_t epoch = 0;
};
/// Up to `max` of them by name, after `after`.
Result<std::vector<OwnerRow>> ReadOwners(Connection& connection, const std::string& after, std::int64_t max);

/// Gives a map from its owner to another server, or (0) to none. No effect if that server is not the owner with that
/// epoch. Waits for a running commit of the map.
Status GiveMap(Connection& connection, std::int64_t map_key, std::int64_t owner, std::int64_t epoch, std::int64_t to);
/// Removes a server that ends: its maps have no owner then.
Status LeaveFleet(Connection& connection, std::int64_t server);
/// Deletes rows of servers that own nothing.
Status ForgetServers(Connection& connection, std::span<const std::int64_t> servers);

/// For maps by name: the present revision and commit_id, which changes with every commit. Leaves out missing maps.
struct PresentCommit {
  std::int64_t map_key = 0;
  std::int64_t revision = 0;
  std::int64_t commit_id = 0;
  friend bool operator==(const PresentCommit&, const PresentCommit&) = default;
};
Result<std::map<std::string, PresentCommit>> ReadPresent(Connection& connection, const std::vector<std::string>& maps);

}  // namespace dhpmap::postgres
