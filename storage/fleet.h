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

/// The copies that a process keeps of other servers' maps, which follow their commits.
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
  bool is_alive = false;     ///< its last beat is younger than the lease, by this process's clock
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

/// A map and its owner; MapOwner::server is 0 if the map has no owner.
struct OwnedMap {
  std::string map;
  MapOwner owner;
};

/// The processes that share a store. Each map has at most one owner, the only process that writes it. Each commit
/// carries the owner's epoch, and is refused once another process has taken the map. Thread-safe. Calls query the
/// database unless they say otherwise: UNAVAILABLE if it does not answer.
class Fleet {
 public:
  virtual ~Fleet() = default;

  /// Publishes the address of this process once its door is open. Until then other servers cannot reach it.
  virtual void Announce(const std::string& address) { (void)address; }
  /// This process, as the others see it, without FleetServer::following. Makes no queries.
  [[nodiscard]] virtual FleetServer Me() const = 0;
  /// All living servers, and dead ones that still own maps.
  virtual Result<std::vector<FleetServer>> ListServers() = 0;

  /// Makes no queries.
  [[nodiscard]] virtual FleetSchema Schema() const { return {}; }
  /// Brings the store to the newest schema once every living server knows it; no effect if it is there. After that,
  /// older servers do not start on this store. FAILED_PRECONDITION names the living servers that do not know it;
  /// UNAVAILABLE, too, if a lock is not free in time: nothing is changed then.
  virtual Result<FleetSchema> FinishUpgrade() { return Schema(); }

  /// At most `max` maps with names above `after`, by name, with their owners in the database, dead ones included.
  virtual Result<std::vector<OwnedMap>> ListOwners(const std::string& after, std::size_t max) = 0;

  /// The owner, if this process knows one that is alive. Makes no queries, never blocks.
  [[nodiscard]] virtual std::optional<MapOwner> KnownOwner(const std::string& map) const = 0;
  /// The owner. If no living server owns the map, this process takes it. NOT_FOUND; UNAVAILABLE, reason
  /// OWNER_UNREACHABLE, if the owner has died and this process may not take the map (it drains, or its own beats fail).
  virtual Result<MapOwner> OwnerOf(const std::string& map) = 0;
  /// Forgets the known owner of a map, after that server turned out not to own it.
  virtual void Forget(const std::string& map) = 0;

  /// Gives up a map of this process that is closed here: to a server, or (0) to the first one that asks for it. OK if
  /// this process does not own the map. FAILED_PRECONDITION if that server is dead or drains.
  virtual Status GiveUp(const std::string& map, std::int64_t to_server) = 0;
  /// Sets the callback for maps of this process that another one has taken; the listener closes the open map. It runs
  /// on any thread, and must be quick. Replaces the previous callback, and waits until its calls have ended. Empty:
  /// none.
  virtual void OnLost(std::function<void(const std::string& map)> on_lost) { (void)on_lost; }
  /// Takes no more maps. This process keeps its maps until they are given up.
  virtual void StopTaking() = 0;

  /// Whether own beats succeeded so recently that no other process can have taken a map of this one. If not, this
  /// process must not answer for its maps. Makes no queries.
  [[nodiscard]] virtual bool MayAnswer() const = 0;

  /// Sets the callback for commits of other processes to maps of `SetFollowed`. It runs on a thread of the fleet: soon
  /// after each commit, once for each map that joins the set, and with revision 0 for a deleted map. Call once, before
  /// the first SetFollowed.
  virtual void OnChange(std::function<void(const std::string& map, std::int64_t revision)> on_change) = 0;
  /// Sets the maps whose commits are reported; replaces the previous set.
  virtual void SetFollowed(std::vector<std::string> maps) = 0;
  /// Sets the function that measures the copies at each beat, for the other servers to see. It must be quick, and runs
  /// on any thread. Call before SetFollowed.
  virtual void MeasureFollowing(std::function<FollowingState()> measure) { (void)measure; }

  /// Makes no queries.
  [[nodiscard]] virtual FleetCounts Counts() const { return {}; }
};

}  // namespace dhpmap
