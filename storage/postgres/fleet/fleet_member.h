// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/fleet.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/fleet/fleet_rows.h"
#include "storage/postgres/fleet/peers.h"
#include "storage/postgres/owners/map_ownership.h"
#include "storage/postgres/pool.h"
#include "storage/postgres/schema.h"

namespace dhpmap::postgres {

/// This process as a member of the fleet. One thread with its own connection beats, and looks for commits to followed
/// maps. Thread-safe.
class FleetMember final : public Fleet {
 public:
  /// All outlive it. Call Start next.
  FleetMember(Pool& pool, Peers& peers, MapOwnership& maps, postgres::Schema& schema, ConnectionOptions connection);
  /// Gives all maps up and leaves, if the database answers within seconds.
  ~FleetMember() override;
  FleetMember(const FleetMember&) = delete;
  FleetMember& operator=(const FleetMember&) = delete;

  /// The first beat; then, with `by_itself`, the thread goes on. UNAVAILABLE if the database does not answer.
  Status Start(const std::string& address, const std::string& version, bool by_itself);
  /// One beat, and one look at followed maps: what the thread does. For tests without it.
  Status Beat() DHPMAP_EXCLUDES(connection_mutex_, mutex_);
  Status LookAtFollowed() DHPMAP_EXCLUDES(connection_mutex_, mutex_);

  [[nodiscard]] FleetServer Me() const override;
  Result<std::vector<FleetServer>> ListServers() override;
  [[nodiscard]] FleetSchema Schema() const override;
  Result<FleetSchema> FinishUpgrade() override;
  Result<std::vector<dhpmap::OwnedMap>> ListOwners(const std::string& after, std::size_t max) override;
  [[nodiscard]] std::optional<MapOwner> KnownOwner(const std::string& map) const override;
  Result<MapOwner> OwnerOf(const std::string& map) override;
  void Forget(const std::string& map) override;
  Status GiveUp(const std::string& map, std::int64_t to_server) override;
  void StopTaking() override;
  [[nodiscard]] bool MayAnswer() const override { return peers_.IsFresh(); }
  void Announce(const std::string& address) override;
  void OnLost(std::function<void(const std::string& map)> on_lost) override { maps_.OnLost(std::move(on_lost)); }
  void OnChange(std::function<void(const std::string& map, std::int64_t revision)> on_change) override;
  void SetFollowed(std::vector<std::string> maps) override;
  void MeasureFollowing(std::function<FollowingState()> measure) override;
  [[nodiscard]] FleetCounts Counts() const override;

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kLook{50};

  void Loop() DHPMAP_EXCLUDES(mutex_);
  void WakeNow() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] ServerRow OwnRow() const DHPMAP_EXCLUDES(mutex_);
  /// The state of this process's copies; none if the schema has no columns for it.
  [[nodiscard]] std::optional<FollowingState> Following() const DHPMAP_EXCLUDES(mutex_);
  Status BeatOnce() DHPMAP_EXCLUDES(connection_mutex_, mutex_);
  /// Connects if necessary.
  Result<Connection*> Connected() DHPMAP_REQUIRES(connection_mutex_);
  /// Drops maps that others have taken while this process did not beat.
  Status LookThroughMaps() DHPMAP_REQUIRES(connection_mutex_);
  [[nodiscard]] FleetServer Describe(const ServerWithMaps& server);

  Pool& pool_;
  Peers& peers_;
  MapOwnership& maps_;
  postgres::Schema& schema_;
  const ConnectionOptions options_;
  const std::chrono::nanoseconds period_;

  Mutex connection_mutex_;  // held while the database is asked; taken before the other
  std::optional<Connection> connection_ DHPMAP_GUARDED_BY(connection_mutex_);
  std::int64_t num_beats_ DHPMAP_GUARDED_BY(connection_mutex_) = 0;
  std::map<std::string, PresentCommit> seen_ DHPMAP_GUARDED_BY(connection_mutex_);  ///< of the followed maps

  mutable Mutex mutex_;
  CondVar wake_;
  std::string address_ DHPMAP_GUARDED_BY(mutex_), version_ DHPMAP_GUARDED_BY(mutex_);
  bool is_draining_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_beat_due_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::vector<std::string> followed_ DHPMAP_GUARDED_BY(mutex_);
  std::int64_t num_failed_beats_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::function<FollowingState()> measure_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::string, MapOwner> others_ DHPMAP_GUARDED_BY(mutex_);  ///< owners of maps that are not ours; bounded
  std::function<void(const std::string&, std::int64_t)> on_change_;   ///< constant after the first SetFollowed
  std::thread thread_;                                                // last
};

}  // namespace dhpmap::postgres
