// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/postgres/fleet/peers.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/pool.h"
#include "storage/postgres/rows/map_head.h"

namespace dhpmap::postgres {

/// The maps that this process owns, and therefore writes. It takes a map when the map is first loaded or written,
/// unless a living server owns it. Thread-safe; no call about one map waits for another map.
class MapOwnership {
 public:
  /// Both outlive it.
  MapOwnership(Pool& pool, Peers& peers, PassingTime time);

  /// The owner of a map: this process or another server.
  struct Claim {
    std::shared_ptr<OwnedMap> ours;  ///< null: another server owns it
    std::int64_t server = 0;
    std::int64_t epoch = 0;
  };
  /// Takes the map unless a living server owns it. If this process has not yet seen a beat of the owner, waits up to
  /// one lease to learn whether it is alive. NOT_FOUND; DATA_LOSS if the map's row is damaged; UNAVAILABLE, reason
  /// OWNER_UNREACHABLE (this process takes no more maps) or DATABASE_UNREACHABLE.
  Result<Claim> ClaimMap(const std::string& name) DHPMAP_EXCLUDES(mutex_);

  /// Why the caller needs the map. A map that was lost or given up must be loaded again before it is written.
  enum class For { kLoading, kWriting };
  /// As ClaimMap; UNAVAILABLE, reason NOT_OWNER, if another server owns the map.
  Result<std::shared_ptr<OwnedMap>> Own(const std::string& name, For what) DHPMAP_EXCLUDES(mutex_);
  /// Null if this process does not own it.
  [[nodiscard]] std::shared_ptr<OwnedMap> Find(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  struct Counts {
    std::int64_t num_owned = 0;       ///< now
    std::int64_t num_taken_over = 0;  ///< from servers that had died
    std::int64_t num_lost = 0;        ///< to others, which held us for dead
  };
  [[nodiscard]] Counts counts() const DHPMAP_EXCLUDES(mutex_);
  /// For a map that the caller is about to create.
  [[nodiscard]] std::shared_ptr<OwnedMap> New(const std::string& name) const;
  void Add(std::shared_ptr<OwnedMap> map) DHPMAP_EXCLUDES(mutex_);
  /// After a deletion.
  void Drop(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_);
  /// After the map was given up. False if this process no longer owned it.
  bool Leave(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_);
  /// After another server has taken the map: calls on_lost.
  void Lose(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_, told_mutex_);
  /// The same; asks the database for the owner, and returns NOT_OWNER with its address.
  Status LoseAndAsk(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_, told_mutex_);

  /// Sets the callback for lost maps, which runs on any thread. Waits until running calls of the previous one end.
  void OnLost(std::function<void(const std::string& map)> on_lost) DHPMAP_EXCLUDES(told_mutex_);
  /// Takes no more maps.
  void StopTaking() DHPMAP_EXCLUDES(mutex_);
  /// The maps of this process, to check that it still owns them after a time in which others may have taken them.
  /// Claims that run meanwhile check their map once more.
  std::vector<std::shared_ptr<OwnedMap>> BeginLookThrough() DHPMAP_EXCLUDES(mutex_);
  /// After a beat by the fleet's thread: wakes claims that wait for news of other servers.
  void OnBeaten() DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::int64_t server() const { return peers_.me(); }
  /// UNAVAILABLE, reason NOT_OWNER, with the address of `owner` if that is known.
  [[nodiscard]] Status NotOwnerBut(std::int64_t owner, const std::string& map) const;

 private:
  class Turn;
  using Clock = std::chrono::steady_clock;

  Result<Claim> ClaimInTurn(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  Result<MapHead> ReadMapHead(const std::string& name);
  /// Whether a row that would get a new checksum has a wrong one.
  Result<bool> IsDamaged(const std::string& name, const MapHead& head);
  [[nodiscard]] Status MayTake(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  /// False once `end` has passed.
  bool AwaitBeat(Clock::time_point end) DHPMAP_EXCLUDES(mutex_);
  /// Null if the claim must check the map once more.
  std::shared_ptr<OwnedMap> Keep(const std::string& name, const MapHead& seen, std::int64_t round)
      DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::int64_t Round() DHPMAP_EXCLUDES(mutex_);
  bool Erase(const OwnedMap& map) DHPMAP_REQUIRES(mutex_);

  Pool& pool_;
  Peers& peers_;
  const PassingTime time_;
  mutable Mutex mutex_;
  CondVar is_claimed_, is_beaten_;
  std::map<std::string, std::shared_ptr<OwnedMap>> maps_ DHPMAP_GUARDED_BY(mutex_);
  std::set<std::string> claimed_ DHPMAP_GUARDED_BY(mutex_);  ///< being taken
  std::set<std::string> left_ DHPMAP_GUARDED_BY(mutex_);     ///< lost or given up, and not loaded since
  std::int64_t round_ DHPMAP_GUARDED_BY(mutex_) = 0;         ///< counts BeginLookThrough
  std::int64_t num_beats_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::int64_t num_taken_over_ DHPMAP_GUARDED_BY(mutex_) = 0, num_lost_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool takes_ DHPMAP_GUARDED_BY(mutex_) = true;
  Mutex told_mutex_;
  std::function<void(const std::string& map)> on_lost_ DHPMAP_GUARDED_BY(told_mutex_);
};

}  // namespace dhpmap::postgres
