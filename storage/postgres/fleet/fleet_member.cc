// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/fleet/fleet_member.h"

#include <algorithm>
#include <utility>

namespace dhpmap::postgres {
namespace {

constexpr std::size_t kMostOthers = 100'000;

bool IsAlive(Peers::Verdict verdict) { return verdict != Peers::Verdict::kDead; }

std::optional<double> BeatAge_s(const Peers::Opinion& opinion) {
  if (opinion.beat == Peers::kNoRow) return std::nullopt;
  return static_cast<double>(opinion.age_ns) * 1e-9;
}

}  // namespace

FleetServer FleetMember::Me() const {
  const ServerRow row = OwnRow();
  return {.id = row.server,
          .address = row.address,
          .version = row.version,
          .is_alive = true,
          .is_draining = row.is_draining,
          .is_me = true,
          .num_maps = maps_.counts().num_owned,
          .newest_schema = row.knows_schema,
          .beat_age_s = BeatAge_s(peers_.OpinionOf(row.server))};
}

FleetServer FleetMember::Describe(const ServerWithMaps& server) {
  const ServerRow& row = server.row;
  const bool is_me = row.server == peers_.me();
  const Peers::Opinion opinion = peers_.OpinionOf(row.server);
  return {.id = row.server,
          .address = row.address,
          .version = row.version,
          .is_alive = is_me || (row.beat != Peers::kNoRow && IsAlive(opinion.verdict)),
          .is_draining = row.is_draining,
          .is_me = is_me,
          .num_maps = server.num_maps,
          .newest_schema = row.knows_schema,
          .beat_age_s = BeatAge_s(opinion),
          .following = server.following};
}

Result<std::vector<FleetServer>> FleetMember::ListServers() {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<ServerWithMaps> rows,
                          pool_.Read<std::vector<ServerWithMaps>>([this](Connection& connection) {
                            return ReadServers(connection, schema_.Has(kFollowingStep));
                          }));
  std::vector<FleetServer> servers;
  for (const ServerWithMaps& row : rows) {
    FleetServer server = Describe(row);
    if (server.is_alive || server.num_maps > 0) servers.push_back(std::move(server));
  }
  return servers;
}

Result<std::vector<dhpmap::OwnedMap>> FleetMember::ListOwners(const std::string& after, std::size_t max) {
  const auto num = static_cast<std::int64_t>(std::min<std::size_t>(max, 100'000));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<OwnerRow> rows,
                          pool_.Read<std::vector<OwnerRow>>([&](Connection& c) { return ReadOwners(c, after, num); }));
  std::vector<dhpmap::OwnedMap> owners;
  owners.reserve(rows.size());
  for (const OwnerRow& row : rows) {
    const auto server = peers_.Find(row.server);
    owners.push_back({row.map,
                      {.server = row.server,
                       .epoch = row.epoch,
                       .address = server ? server->address : std::string(),
                       .is_me = row.server == peers_.me()}});
  }
  return owners;
}

std::optional<MapOwner> FleetMember::KnownOwner(const std::string& map) const {
  if (const auto ours = maps_.Find(map)) {
    const MutexLock lock(mutex_);
    return MapOwner{.server = peers_.me(), .epoch = ours->epoch, .address = address_, .is_me = true};
  }
  std::optional<MapOwner> other;
  {
    const MutexLock lock(mutex_);
    const auto found = others_.find(map);
    if (found != others_.end()) other = found->second;
  }
  if (!other || peers_.OpinionOf(other->server).verdict != Peers::Verdict::kAlive) return std::nullopt;
  const auto row = peers_.Find(other->server);
  if (!row || row->address.empty()) return std::nullopt;
  other->address = row->address;
  return other;
}

Result<MapOwner> FleetMember::OwnerOf(const std::string& map) {
  DHPMAP_ASSIGN_OR_RETURN(const MapOwnership::Claim claim, maps_.ClaimMap(map));
  const MutexLock lock(mutex_);
  MapOwner owner{.server = claim.server, .epoch = claim.epoch, .address = address_, .is_me = claim.ours != nullptr};
  if (owner.is_me) {
    others_.erase(map);
    return owner;
  }
  const auto row = peers_.Find(claim.server);
  if (!row || row->address.empty()) {
    return Unavailable("the owner of map '" + map + "' has not said where it is").WithReason("OWNER_UNREACHABLE");
  }
  owner.address = row->address;
  if (others_.size() >= kMostOthers) others_.erase(others_.begin());
  others_[map] = owner;
  return owner;
}

void FleetMember::Forget(const std::string& map) {
  const MutexLock lock(mutex_);
  others_.erase(map);
}

Status FleetMember::GiveUp(const std::string& map, std::int64_t to_server) {
  const auto ours = maps_.Find(map);
  if (ours == nullptr || to_server == peers_.me()) return Status::Ok();
  if (to_server != 0) {
    const auto row = peers_.Find(to_server);
    if (!row || row->is_draining || !IsAlive(peers_.OpinionOf(to_server).verdict)) {
      return FailedPrecondition("map '" + map + "' stays where it is: that server is not there, or takes no maps");
    }
  }
  const MutexLock lock(ours->mutex);
  // Repeating it does no harm: the map is then no longer ours.
  const auto given = pool_.Read<bool>([&](Connection& connection) -> Result<bool> {
    DHPMAP_RETURN_IF_ERROR(GiveMap(connection, ours->key, peers_.me(), ours->epoch, to_server));
    return true;
  });
  if (!given.ok()) return given.status();
  maps_.Leave(*ours);
  return Status::Ok();
}

void FleetMember::StopTaking() {
  maps_.StopTaking();
  {
    const MutexLock lock(mutex_);
    is_draining_ = true;
  }
  WakeNow();
}

void FleetMember::Announce(const std::string& address) {
  {
    const MutexLock lock(mutex_);
    address_ = address;
  }
  WakeNow();
}

}  // namespace dhpmap::postgres
