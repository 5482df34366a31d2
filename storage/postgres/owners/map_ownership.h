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

/// The maps that this process writes. A map is taken when it is first loaded or written, if nobody alive has it.
/// Thread-safe; no call on one map waits for another map.
class MapOwnership {
 public:
  /// Both outlive it.
  MapOwnership(Pool& pool, Peers& peers, PassingTime time);

  /// Who writes a map: we, or another server.
  struct Claim {
    std::shared_ptr<OwnedMap> ours;  ///< null: another does
    std::int64_t server = 0;
    std::int64_t epoch = 0;
  };
  /// Takes the map if nobody alive has it. NOT_FOUND; DATA_LOSS if its row is damaged; UNAVAILABLE, reason
  /// OWNER_UNREACHABLE (this process takes no more) or DATABASE_UNREACHABLE. Waits for up to a lease until it is clear
  /// whether an owner that was never seen to beat is alive.
  Result<Claim> ClaimMap(const std::string& name) DHPMAP_EXCLUDES(mutex_);

  /// What a map is wanted for. One that was lost, or given up, is not written before it is loaded anew.
  enum class For { kLoading, kWriting };
  /// The same; UNAVAILABLE, reason NOT_OWNER, if another server has it.
  Result<std::shared_ptr<OwnedMap>> Own(const std::string& name, For what) DHPMAP_EXCLUDES(mutex_);
  /// Null if it is not ours.
  [[nodiscard]] std::shared_ptr<OwnedMap> Find(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::int64_t num_maps() DHPMAP_EXCLUDES(mutex_);
  /// A map that is going to be created.
  [[nodiscard]] std::shared_ptr<OwnedMap> New(const std::string& name) const;
  void Add(std::shared_ptr<OwnedMap> map) DHPMAP_EXCLUDES(mutex_);
  /// After a deletion.
  void Drop(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_);
  /// It was given up. False if it was not ours any more.
  bool Leave(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_);
  /// Somebody else has taken it: calls on_lost.
  void Lose(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_, told_mutex_);
  /// The same; returns NOT_OWNER, and asks the database who has it.
  Status LoseAndAsk(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_, told_mutex_);

  /// Called with each map that is lost, on any thread; waits until a call of the last one has ended.
  void OnLost(std::function<void(const std::string& map)> on_lost) DHPMAP_EXCLUDES(told_mutex_);
  /// Takes no more maps.
  void StopTaking() DHPMAP_EXCLUDES(mutex_);
  /// The maps that we have, to look through whether we still do: after a time in which others may have taken them. What
  /// is being taken meanwhile is looked at once more.
  std::vector<std::shared_ptr<OwnedMap>> BeginLookThrough() DHPMAP_EXCLUDES(mutex_);
  /// Own beats have told more about others, and go on without being asked to.
  void OnBeaten() DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::int64_t server() const { return peers_.me(); }
  /// UNAVAILABLE, reason NOT_OWNER, with the address of `owner` if that is known.
  [[nodiscard]] Status NotOwnerBut(std::int64_t owner, const std::string& map) const;

 private:
  class Turn;
  using Clock = std::chrono::steady_clock;

  Result<Claim> ClaimInTurn(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  Result<MapHead> ReadMapHead(const std::string& name);
  [[nodiscard]] Status MayTake(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  /// False when it has taken too long.
  bool AwaitBeat(Clock::time_point end) DHPMAP_EXCLUDES(mutex_);
  /// Null if it must be looked at once more.
  std::shared_ptr<OwnedMap> Keep(const std::string& name, const MapHead& seen, std::int64_t round)
      DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::int64_t Round() DHPMAP_EXCLUDES(mutex_);
  bool Erase(const OwnedMap& map) DHPMAP_REQUIRES(mutex_);

  Pool& pool_;
  Peers& peers_;
  const PassingTime time_;
  Mutex mutex_;
  CondVar is_claimed_, is_beaten_;
  std::map<std::string, std::shared_ptr<OwnedMap>> maps_ DHPMAP_GUARDED_BY(mutex_);
  std::set<std::string> claimed_ DHPMAP_GUARDED_BY(mutex_);  ///< are being taken
  std::set<std::string> left_ DHPMAP_GUARDED_BY(mutex_);     ///< were lost or given up, and not loaded since
  std::int64_t round_ DHPMAP_GUARDED_BY(mutex_) = 0;         ///< of looking through
  std::int64_t num_beats_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool takes_ DHPMAP_GUARDED_BY(mutex_) = true;
  Mutex told_mutex_;
  std::function<void(const std::string& map)> on_lost_ DHPMAP_GUARDED_BY(told_mutex_);
};

}  // namespace dhpmap::postgres
