// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/app/map_session.h"
#include "storage/store.h"

namespace dhpmap {

struct MapSummary {
  MapInfo info;
  std::int64_t num_submaps = 0;  ///< the unknown submap included
  Status damage;                 ///< why the store cannot read the map; then of all else only info.name is valid
};

/// All maps of a store. A map is loaded when somebody first asks for more than its summary, and stays open.
/// Thread-safe; no call on one map waits for another map.
class MapRegistry {
 public:
  /// Reads the list of maps. The store outlives the registry, and nobody else writes to it.
  static Result<std::unique_ptr<MapRegistry>> Open(MapStore& store, SessionOptions options);
  /// Shutdown().
  ~MapRegistry();

  /// Adds a map with `info`'s name, display name, config (must be valid) and label set. INVALID_ARGUMENT for a bad
  /// name, ALREADY_EXISTS.
  Result<MapSummary> Create(MapInfo info);
  /// NOT_FOUND if there is no such map, DATA_LOSS if it is damaged.
  Result<MapSummary> Get(const std::string& name) const;
  /// By name, damaged ones included.
  [[nodiscard]] std::vector<MapSummary> List() const;
  /// Returns the last revision. FAILED_PRECONDITION while frames are being streamed into the map. Blocks.
  Result<std::int64_t> Delete(const std::string& name);

  /// The open map; loads it, which blocks, if it is not open yet. Errors of MapStore::LoadMap are passed on, and the
  /// next call tries again.
  Result<std::shared_ptr<MapSession>> OpenSession(const std::string& name);
  /// Bytes of encoded blocks in the store.
  Result<std::int64_t> DiskBytes(const std::string& name);
  [[nodiscard]] std::vector<std::shared_ptr<MapSession>> OpenSessions() const;

  /// Stops every session: see MapSession::Stop. What is open can still be read; a map that is not open can no longer be
  /// opened (UNAVAILABLE). Returns why a map's last state could not be stored, or OK.
  Status Shutdown();

 private:
  /// A map that is there, or is just being made.
  struct Entry {
    std::mutex busy;  ///< held while the map is made, loaded or deleted
    // Guarded by MapRegistry::mutex_.
    bool exists = false;
    MapSummary stored;  ///< while there is no session
    std::shared_ptr<MapSession> session;
  };

  MapRegistry(MapStore& store, SessionOptions options) : store_(store), options_(std::move(options)) {}
  [[nodiscard]] std::shared_ptr<Entry> FindEntry(const std::string& name) const;
  [[nodiscard]] static MapSummary Summarise(const Entry& entry);
  /// Puts a session into the entry; null if the registry is shut down.
  std::shared_ptr<MapSession> Install(Entry& entry, std::shared_ptr<const MapSnapshot> snapshot);

  MapStore& store_;
  const SessionOptions options_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Entry>> entries_;  // guarded by mutex_
  bool is_shut_down_ = false;                              // guarded by mutex_
};

}  // namespace dhpmap
