// SPDX-License-Identifier: BSD-3-Clause
// MapOwnership::ClaimMap: takes a map.
#include <algorithm>
#include <chrono>
#include <utility>

#include "storage/postgres/fleet/takeover.h"
#include "storage/postgres/owners/map_ownership.h"
#include "storage/postgres/reading/named_map.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

constexpr int kMostTries = 8;
/// After this many lock timeouts of half a second each, the dead owner's connections are ended.
constexpr int kBlockedUntilEnded = 2;

Status NobodyTakes(const std::string& map, const std::string& why) {
  return Unavailable("map '" + map + "' has no owner, and this server does not take it: " + why)
      .WithReason("OWNER_UNREACHABLE");
}

}  // namespace

/// One thread claims a map while the others wait for its result.
class MapOwnership::Turn {
 public:
  Turn(MapOwnership& maps, const std::string& name) : maps_(maps), name_(name) {
    const MutexLock lock(maps_.mutex_);
    const auto is_free = [this]() DHPMAP_REQUIRES(maps_.mutex_) { return !maps_.claimed_.contains(name_); };
    maps_.is_claimed_.Wait(maps_.mutex_, is_free);
    maps_.claimed_.insert(name_);
  }
  ~Turn() {
    const MutexLock lock(maps_.mutex_);
    maps_.claimed_.erase(name_);
    maps_.is_claimed_.NotifyAll();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  MapOwnership& maps_;
  const std::string& name_;
};

Result<MapOwnership::Claim> MapOwnership::ClaimMap(const std::string& name) {
  if (auto ours = Find(name)) return Claim{ours, server(), ours->epoch};
  const Turn turn(*this, name);
  if (auto ours = Find(name)) return Claim{ours, server(), ours->epoch};
  return ClaimInTurn(name);
}

Result<MapOwnership::Claim> MapOwnership::ClaimInTurn(const std::string& name) {
  const auto end = Clock::now() + std::chrono::nanoseconds(peers_.lease_ns()) + std::chrono::seconds(1);
  int num_blocked = 0;
  bool was_lost = false;
  std::int64_t refused_at = 0;  // commit_id at which an owner seemed dead and was not
  for (int n = 0; n < kMostTries; ++n) {
    const std::int64_t round = Round();
    DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadMapHead(name));
    Taking taking{.seen = head, .server = server()};
    const bool is_anothers = head.owner != 0 && head.owner != server();
    if (is_anothers) {
      const Peers::Opinion opinion = peers_.OpinionOf(head.owner);
      taking.beat = opinion.beat;
      const bool is_unclear = opinion.verdict == Peers::Verdict::kUnclear && peers_.IsFresh();
      if (is_unclear && AwaitBeat(end)) {
        --n;
        continue;
      }
      const bool has_beaten_since = refused_at == head.commit_id;
      if (has_beaten_since && AwaitBeat(end)) {
        refused_at = 0;
        continue;
      }
      if (has_beaten_since || opinion.verdict != Peers::Verdict::kDead) {
        return Claim{nullptr, head.owner, head.owner_epoch};
      }
    }
    DHPMAP_RETURN_IF_ERROR(MayTake(name));
    DHPMAP_ASSIGN_OR_RETURN(taking.is_damaged, IsDamaged(name, head));
    const Result<Taken> taken = [&]() -> Result<Taken> {
      DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow(was_lost));
      Result<Taken> done = Take(*connection, taking);
      if (done.ok() && *done == Taken::kBlocked && ++num_blocked >= kBlockedUntilEnded && is_anothers) {
        DHPMAP_RETURN_IF_ERROR(EndConnectionsOf(*connection, head.owner));
      }
      return done;
    }();
    if (!taken.ok()) {  // the answer was lost: the map may be ours
      if (was_lost || taken.status().code() != StatusCode::kUnavailable) return taken.status();
      was_lost = true;
    }
    if (taken.ok() && *taken == Taken::kChangedMeanwhile) refused_at = head.commit_id;
    if (!taken.ok() || *taken != Taken::kYes) continue;
    if (auto ours = Keep(name, head, round)) return Claim{ours, server(), ours->epoch};
  }
  return NobodyTakes(name, "others take it at the same time, or hold it");
}

Result<MapHead> MapOwnership::ReadMapHead(const std::string& name) {
  return pool_.Read<MapHead>([&](Connection& connection) -> Result<MapHead> {
    Call call{&HeadByName()};
    call.values.Add(name);
    DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, "ask who has a map"));
    if (!answer.Next()) return NoSuchMap(name);
    MapHead head;
    if (!ReadHead(answer, head)) return DamagedRows(name, "its row has a wrong checksum");
    return head;
  });
}

Result<bool> MapOwnership::IsDamaged(const std::string& name, const MapHead& head) {
  if (!HasReservedNumbers(head.row)) return false;
  return pool_.Read<bool>([&name](Connection& connection) -> Result<bool> {
    DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
    const Status read = ReadNamedMap(connection, name).status();
    if (read.code() == StatusCode::kUnavailable) return read;
    return read.code() == StatusCode::kDataLoss;
  });
}

Status MapOwnership::MayTake(const std::string& name) {
  if (!peers_.IsFresh()) {
    return Unavailable("map '" + name + "' cannot be taken: the database does not answer in time")
        .WithReason("DATABASE_UNREACHABLE");
  }
  const MutexLock lock(mutex_);
  return takes_ ? Status::Ok() : NobodyTakes(name, "it is shutting down");
}

bool MapOwnership::AwaitBeat(Clock::time_point end) {
  const MutexLock lock(mutex_);
  const std::int64_t before = num_beats_;
  if (before == 0) return false;  // no thread beats: a test does
  return is_beaten_.WaitUntil(mutex_, end, [&]() DHPMAP_REQUIRES(mutex_) { return num_beats_ != before; });
}

std::shared_ptr<OwnedMap> MapOwnership::Keep(const std::string& name, const MapHead& seen, std::int64_t round) {
  auto map = std::make_shared<OwnedMap>(name, seen.row.key, seen.owner_epoch + 1, seen.seen_ns, time_);
  const MutexLock lock(mutex_);
  if (round_ != round) return nullptr;
  if (seen.owner != 0 && seen.owner != server()) ++num_taken_over_;
  maps_[name] = map;
  return map;
}

}  // namespace dhpmap::postgres
