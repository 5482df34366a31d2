// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/fleet/fleet_rows.h"

#include <cmath>
#include <utility>

namespace dhpmap::postgres {
namespace {

constexpr char kBeatTask[] = "tell the other servers that this one lives";
constexpr char kServersTask[] = "list the servers";
constexpr char kGiveTask[] = "give a map to another server";
constexpr char kFollowTask[] = "look for new commits";
const std::string kBeat =
    "INSERT INTO servers (server, beat, address, version, is_draining, knows_schema) VALUES ($1, 1, $2, $3, $4, $5) ON "
    "CONFLICT (server) DO UPDATE SET beat = servers.beat + 1, address = excluded.address, version = excluded.version, "
    "is_draining = excluded.is_draining, knows_schema = excluded.knows_schema";
const std::string kNoteFollowing = "UPDATE servers SET num_copies = $2, behind_ns = $3 WHERE server = $1";
const std::string kNewestStep = "SELECT coalesce(max(step), 0) FROM schema_steps";
const std::string kReadAll =
    "SELECT server, beat, address, version, is_draining, knows_schema FROM servers ORDER BY server LIMIT 10000";
const std::string kEpochs = "SELECT map_key, owner_epoch FROM maps WHERE owner = $1";
const std::string kServersWithMaps =
    "SELECT coalesce(s.server, o.owner), coalesce(s.beat, -1), coalesce(s.address, ''), coalesce(s.version, ''), "
    "coalesce(s.is_draining, 0), coalesce(s.knows_schema, 0), coalesce(o.num, 0) FROM servers s FULL JOIN (SELECT "
    "owner, count(*) AS num FROM maps WHERE owner <> 0 GROUP BY owner) o ON o.owner = s.server ORDER BY 1 LIMIT 10000";
const std::string kFollowing = "SELECT server, num_copies, behind_ns FROM servers ORDER BY server LIMIT 10000";
const std::string kOwners =
    "SELECT n.name, m.owner, m.owner_epoch FROM map_names n JOIN maps m ON m.map_key = n.map_key WHERE n.name > $1 "
    "ORDER "
    "BY n.name LIMIT $2";
const std::string kGive =
    "UPDATE maps SET owner = $4, owner_epoch = owner_epoch + 1 WHERE map_key = $1 AND owner = $2 AND owner_epoch = $3";
const std::string kLeaveMaps = "UPDATE maps SET owner = 0, owner_epoch = owner_epoch + 1 WHERE owner = $1";
const std::string kLeave = "DELETE FROM servers WHERE server = $1";
const std::string kForget =
    "DELETE FROM servers WHERE server = ANY ($1) AND NOT EXISTS (SELECT 1 FROM maps WHERE maps.owner = servers.server)";
// Names have no commas.
const std::string kPresent =
    "SELECT n.name, m.map_key, m.revision, m.commit_id FROM map_names n JOIN maps m ON m.map_key = n.map_key WHERE "
    "n.name = ANY (string_to_array($1, ','))";

ServerRow ReadServer(Answer& answer) {
  ServerRow row;
  row.server = answer.Int();
  row.beat = answer.Int();
  row.address = answer.Text();
  row.version = answer.Text();
  row.is_draining = answer.Int() != 0;
  row.knows_schema = answer.Int();
  return row;
}

}  // namespace

Result<BeatAnswer> WriteBeat(Connection& connection, const ServerRow& me,
                             const std::optional<FollowingState>& following) {
  std::vector<Call> calls = {{&kBeat}, {&kReadAll}, {&kNewestStep}};
  calls[0].values.Add(me.server).Add(me.address).Add(me.version).Add(std::int64_t{me.is_draining}).Add(me.knows_schema);
  if (following) {
    const std::int64_t behind_ns = std::llround(following->behind_s * 1e9);
    calls.emplace_back(Call{&kNoteFollowing}).values.Add(me.server).Add(following->num_copies).Add(behind_ns);
  }
  Answers done = connection.Run(calls, kBeatTask);
  if (done.sqlstate == "23514") {  // check_violation: see ForbidOlderServers
    return FailedPrecondition("the database was brought to a schema that this version does not know")
        .WithReason("NEWER_SCHEMA");
  }
  if (!done.status.ok()) return done.status;
  BeatAnswer answer;
  while (done.answers[1].Next()) answer.rows.push_back(ReadServer(done.answers[1]));
  if (done.answers[2].Next()) answer.schema = done.answers[2].Int();
  return answer;
}

Result<std::vector<ServerRow>> ReadRows(Connection& connection) {
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query({&kReadAll}, kServersTask));
  std::vector<ServerRow> rows;
  while (answer.Next()) rows.push_back(ReadServer(answer));
  return rows;
}

Result<std::map<std::int64_t, std::int64_t>> ReadEpochs(Connection& connection, std::int64_t server) {
  Call call{&kEpochs};
  call.values.Add(server);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kBeatTask));
  std::map<std::int64_t, std::int64_t> epochs;
  while (answer.Next()) {
    const std::int64_t key = answer.Int();
    epochs[key] = answer.Int();
  }
  return epochs;
}

Result<std::vector<ServerWithMaps>> ReadServers(Connection& connection, bool has_following) {
  std::vector<Call> calls = {{&kServersWithMaps}};
  if (has_following) calls.push_back({&kFollowing});
  Answers done = connection.Run(calls, kServersTask);
  if (!done.status.ok()) return done.status;
  std::map<std::int64_t, FollowingState> following;
  while (has_following && done.answers[1].Next()) {
    FollowingState& of = following[done.answers[1].Int()];
    of.num_copies = done.answers[1].Int();
    of.behind_s = static_cast<double>(done.answers[1].Int()) * 1e-9;
  }
  std::vector<ServerWithMaps> servers;
  while (done.answers[0].Next()) {
    ServerWithMaps& server = servers.emplace_back();
    server.row = ReadServer(done.answers[0]);
    server.num_maps = done.answers[0].Int();
    const auto found = following.find(server.row.server);
    if (found != following.end()) server.following = found->second;
  }
  return servers;
}

Result<std::vector<OwnerRow>> ReadOwners(Connection& connection, const std::string& after, std::int64_t max) {
  Call call{&kOwners};
  call.values.Add(after).Add(max);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kServersTask));
  std::vector<OwnerRow> owners;
  while (answer.Next()) {
    OwnerRow& row = owners.emplace_back();
    row.map = answer.Text();
    row.server = answer.Int();
    row.epoch = answer.Int();
  }
  return owners;
}

Status GiveMap(Connection& connection, std::int64_t map_key, std::int64_t owner, std::int64_t epoch, std::int64_t to) {
  Call call{&kGive};
  call.values.Add(map_key).Add(owner).Add(epoch).Add(to);
  return connection.Query(call, kGiveTask).status();
}

Status LeaveFleet(Connection& connection, std::int64_t server) {
  std::vector<Call> calls = {{&kLeaveMaps}, {&kLeave}};
  for (Call& call : calls) call.values.Add(server);
  return connection.Run(calls, kGiveTask).status;
}

Status ForgetServers(Connection& connection, std::span<const std::int64_t> servers) {
  Call call{&kForget};
  call.values.Add(servers);
  return connection.Query(call, kServersTask).status();
}

Result<std::map<std::string, PresentCommit>> ReadPresent(Connection& connection, const std::vector<std::string>& maps) {
  std::string names;
  for (const std::string& map : maps) names += (names.empty() ? "" : ",") + map;
  Call call{&kPresent};
  call.values.Add(names);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kFollowTask));
  std::map<std::string, PresentCommit> present;
  while (answer.Next()) {
    PresentCommit& commit = present[answer.Text()];
    commit.map_key = answer.Int();
    commit.revision = answer.Int();
    commit.commit_id = answer.Int();
  }
  return present;
}

}  // namespace dhpmap::postgres
