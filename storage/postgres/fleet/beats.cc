// SPDX-License-Identifier: BSD-3-Clause
// The work of FleetMember's thread.
#include <algorithm>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/base/this_thread.h"
#include "storage/postgres/fleet/fleet_member.h"

namespace dhpmap::postgres {
namespace {

constexpr int kBeatsALease = 12;
constexpr std::int64_t kBeatsUntilTidied = 128;
constexpr char kBeginTask[] = "connect to the database";

/// A silent database must not delay the next beat for longer than a lease.
ConnectionOptions ForBeats(ConnectionOptions options, std::int64_t lease_ns) {
  options.patience = std::chrono::milliseconds(std::max<std::int64_t>(lease_ns / 1'000'000, 200));
  return options;
}

}  // namespace

FleetMember::FleetMember(Pool& pool, Peers& peers, MapOwnership& maps, postgres::Schema& schema,
                         ConnectionOptions connection)
    : pool_(pool),
      peers_(peers),
      maps_(maps),
      schema_(schema),
      options_(ForBeats(std::move(connection), peers.lease_ns())),
      period_(peers.lease_ns() / kBeatsALease) {}

Status FleetMember::Start(const std::string& address, const std::string& version, bool by_itself) {
  {
    const MutexLock lock(mutex_);
    address_ = address;
    version_ = version;
  }
  DHPMAP_RETURN_IF_ERROR(Beat());
  if (by_itself) thread_ = std::thread([this] { Loop(); });
  return Status::Ok();
}

FleetMember::~FleetMember() {
  {
    const MutexLock lock(mutex_);
    is_stopping_ = true;
    wake_.NotifyAll();
  }
  if (thread_.joinable()) thread_.join();
  const MutexLock lock(connection_mutex_);
  if (!connection_) return;  // the database does not answer: others wait for the lease
  Connection& connection = *connection_;
  (void)Guarded<Status>([&] { return LeaveFleet(connection, peers_.me()); });
}

ServerRow FleetMember::OwnRow() const {
  const MutexLock lock(mutex_);
  return {.server = peers_.me(),
          .beat = 0,
          .address = address_,
          .version = version_,
          .is_draining = is_draining_,
          .knows_schema = schema_.newest()};
}

Result<Connection*> FleetMember::Connected() {
  if (connection_ && !connection_->IsBroken()) return &*connection_;
  connection_.reset();
  DHPMAP_ASSIGN_OR_RETURN(Connection opened, Connection::Open(options_));
  // Beats need no durability: the next one follows. So none waits for standbys, nor for long for a lock.
  DHPMAP_RETURN_IF_ERROR(opened.Execute("SET synchronous_commit TO off; SET lock_timeout TO 1000", kBeginTask));
  connection_.emplace(std::move(opened));
  return &*connection_;
}

Status FleetMember::Beat() {
  Status beaten = Guarded<Status>([this] { return BeatOnce(); });
  const MutexLock lock(mutex_);
  if (!beaten.ok()) ++num_failed_beats_;
  return beaten;
}

Status FleetMember::BeatOnce() {
  const std::optional<FollowingState> following = Following();
  const MutexLock lock(connection_mutex_);
  const std::int64_t sent_ns = peers_.Now_ns();
  DHPMAP_ASSIGN_OR_RETURN(Connection* const connection, Connected());
  DHPMAP_ASSIGN_OR_RETURN(const BeatAnswer answer, WriteBeat(*connection, OwnRow(), following));
  schema_.Raise(answer.schema);
  if (peers_.ComesLate(sent_ns)) DHPMAP_RETURN_IF_ERROR(LookThroughMaps());
  peers_.OnBeaten(sent_ns, answer.rows);
  if (++num_beats_ % kBeatsUntilTidied != 0) return Status::Ok();
  const std::vector<std::int64_t> dead = peers_.LongDead();
  return dead.empty() ? Status::Ok() : ForgetServers(*connection, dead);
}

Status FleetMember::LookThroughMaps() {
  const auto maps = maps_.BeginLookThrough();
  if (maps.empty()) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(const auto epochs, ReadEpochs(*connection_, peers_.me()));
  for (const auto& map : maps) {
    const auto found = epochs.find(map->key);
    if (found == epochs.end() || found->second != map->epoch) maps_.Lose(*map);
  }
  return Status::Ok();
}

void FleetMember::WakeNow() {
  const MutexLock lock(mutex_);
  is_beat_due_ = true;
  wake_.NotifyAll();
}

void FleetMember::Loop() {
  NameThisThread("map-fleet");
  auto next_beat = Clock::now() + period_;
  for (;;) {
    bool is_followed = false;
    {
      const MutexLock lock(mutex_);
      const auto until = followed_.empty() ? next_beat : std::min(next_beat, Clock::now() + kLook);
      wake_.WaitUntil(mutex_, until, [this]() DHPMAP_REQUIRES(mutex_) { return is_stopping_ || is_beat_due_; });
      if (is_stopping_) return;
      if (std::exchange(is_beat_due_, false)) next_beat = Clock::now();
      is_followed = !followed_.empty();
    }
    if (Clock::now() >= next_beat) {
      next_beat = Clock::now() + period_;
      if (Beat().ok()) maps_.OnBeaten();
    }
    if (is_followed) (void)Guarded<Status>([this] { return LookAtFollowed(); });
  }
}

}  // namespace dhpmap::postgres
