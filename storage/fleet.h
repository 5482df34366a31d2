// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// A process's copies of maps that others write, which follow their commits.
struct FollowingState {
  std::int64_t num_copies = 0;
  std::int64_t bytes = 0;  ///< of memory
  double behind_s = 0;     ///< since when a copy lacks a commit that its process knows of; 0: none does
};

/// A server process on a store that several processes share.
struct FleetServer {
  std::int64_t id = 0;       ///< drawn at its start
  std::string address;       ///< of its gRPC door, for the other servers and for clients
  std::string version;       ///< of the program
  bool is_alive = false;     ///< it has beaten within the lease, by the clock of who asks
  bool is_draining = false;  ///< it takes no more maps
  bool is_me = false;
  std::int64_t num_maps = 0;                     ///< that it owns
  std::int64_t newest_schema = 0;                ///< of the store, that its version knows
  std::optional<double> beat_age_s = {};         ///< since its last beat was seen; none: no beat is known of it
  std::optional<FollowingState> following = {};  ///< without bytes, as of that beat; none: the schema is older
};

/// The schema of the shared store.
struct FleetSchema {
  std::int64_t in_force = 0;
  std::int64_t newest = 0;  ///< that a living server knows; later than `in_force` during an upgrade
};

/// Of this process, since its start.
struct FleetCounts {
  std::int64_t num_owned = 0;         ///< maps, now
  std::int64_t num_taken_over = 0;    ///< maps, from servers that had died
  std::int64_t num_lost = 0;          ///< maps, to servers that held this one for dead
  std::int64_t num_failed_beats = 0;  ///< the database did not answer, or refused
};

/// The one process that writes a map.
struct MapOwner {
  std::int64_t server = 0;  ///< FleetServer::id
  std::int64_t epoch = 0;   ///< counts the owners of this map; never falls
  std::string address;      ///< FleetServer::address
  bool is_me = false;
};

/// A map and its owner; MapOwner::server is 0 if nobody owns it.
struct OwnedMap {
  std::string map;
  MapOwner owner;
};

/// The processes that share a store. Each map has at most one owner, which alone writes it; each commit carries the
/// owner's epoch and is refused once another has taken the map. Thread-safe. Calls ask the database unless they say
/// otherwise: UNAVAILABLE if it does not answer.
class Fleet {
 public:
  virtual ~Fleet() = default;

  /// Where this process can be reached, once its door is open; until then other servers cannot send it anything.
  virtual void Announce(const std::string& address) { (void)address; }
  /// This process, as the others see it, without FleetServer::following. Asks nobody.
  [[nodiscard]] virtual FleetServer Me() const = 0;
  /// All that are alive, and the dead that still own maps.
  virtual Result<std::vector<FleetServer>> ListServers() = 0;

  /// Asks nobody.
  [[nodiscard]] virtual FleetSchema Schema() const { return {}; }
  /// Brings the store to the newest schema once every living server knows it; no effect if it is there. After that,
  /// older servers do not start on this store. FAILED_PRECONDITION names the living servers that do not know it;
  /// UNAVAILABLE, too, if a lock is not free in time: nothing is changed then.
  virtual Result<FleetSchema> FinishUpgrade() { return Schema(); }

  /// Up to `max` maps by name, from the first after `after` on, with the owners that the database names, dead ones too.
  virtual Result<std::vector<OwnedMap>> ListOwners(const std::string& after, std::size_t max) = 0;

  /// The owner, if it is known and was confirmed recently enough to act on. Asks nobody, never blocks.
  [[nodiscard]] virtual std::optional<MapOwner> KnownOwner(const std::string& map) const = 0;
  /// The owner. If nobody alive owns the map, this process takes it. NOT_FOUND; UNAVAILABLE, reason OWNER_UNREACHABLE,
  /// if its owner has died and this process may not take it (it drains, or its own beats fail).
  virtual Result<MapOwner> OwnerOf(const std::string& map) = 0;
  /// Another server has said, or proved by its answers, that it is not the owner: forget what is known.
  virtual void Forget(const std::string& map) = 0;

  /// Gives a map of ours up, once it is closed here, to a server or (0) to whoever asks first. OK if it is not ours.
  /// FAILED_PRECONDITION if that server is dead or drains.
  virtual Status GiveUp(const std::string& map, std::int64_t to_server) = 0;
  /// Sets the callback for maps of ours that another process has taken; the listener closes the open map. Runs on any
  /// thread, and must be quick. Replaces the previous callback, and waits until no call of that one runs. Empty: none.
  virtual void OnLost(std::function<void(const std::string& map)> on_lost) { (void)on_lost; }
  /// Takes no more maps. Maps that are ours stay so until they are given up.
  virtual void StopTaking() = 0;

  /// Whether own beats have succeeded recently enough that no other process can have taken our maps: else this process
  /// must not answer for them. Asks nobody.
  [[nodiscard]] virtual bool MayAnswer() const = 0;

  /// `on_change(map, revision)` is called, soon after another process has committed, for every map of `SetFollowed`, on
  /// a thread of the fleet; also for each map that comes to these, and with revision 0 for one that is gone. Once,
  /// before the first call of SetFollowed.
  virtual void OnChange(std::function<void(const std::string& map, std::int64_t revision)> on_change) = 0;
  /// The maps whose commits by others are of interest; replaces the last set.
  virtual void SetFollowed(std::vector<std::string> maps) = 0;
  /// `measure` is called with each beat, so that the other servers know: quick, on any thread. Before SetFollowed.
  virtual void MeasureFollowing(std::function<FollowingState()> measure) { (void)measure; }

  /// Asks nobody.
  [[nodiscard]] virtual FleetCounts Counts() const { return {}; }
};

}  // namespace dhpmap
