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

// What servers write to and read from the database about each other. All by autocommit, one round trip each.

/// The step of the schema that has the columns of FollowingState.
inline constexpr std::int64_t kFollowingStep = 6;

/// The rows and the newest step of the schema, as they were right after a beat.
struct BeatAnswer {
  std::vector<ServerRow> rows;
  std::int64_t schema = 0;
};
/// Writes our row with another beat. `following`: none if the schema has no columns for it. FAILED_PRECONDITION, reason
/// NEWER_SCHEMA, if the database was brought to a schema that we do not know.
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

/// The map's owner gives it to another server, or (0) to nobody. Nothing if it is not the owner with that epoch. Waits
/// for a commit that is on its way.
Status GiveMap(Connection& connection, std::int64_t map_key, std::int64_t owner, std::int64_t epoch, std::int64_t to);
/// A server ends: its maps are nobody's, its row goes.
Status LeaveFleet(Connection& connection, std::int64_t server);
/// Deletes rows of servers that own nothing.
Status ForgetServers(Connection& connection, std::span<const std::int64_t> servers);

/// Of maps by name: the present revision and commit_id, which changes with every commit. Who is not there is left out.
struct PresentCommit {
  std::int64_t map_key = 0;
  std::int64_t revision = 0;
  std::int64_t commit_id = 0;
  friend bool operator==(const PresentCommit&, const PresentCommit&) = default;
};
Result<std::map<std::string, PresentCommit>> ReadPresent(Connection& connection, const std::vector<std::string>& maps);

}  // namespace dhpmap::postgres
