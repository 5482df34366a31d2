// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/app/maps/map_registry.h"
#include "server/auth/gate.h"
#include "server/grpc/door_call.h"

namespace dhpmap {

/// Limits the number and the total size of the maps that each principal has made, as auth::CallLimits say. Without keys
/// there is no quota. A map without a known owner counts for no principal. Thread-safe.
class MapQuota {
 public:
  /// How long a sum of bytes is reused: computing it reads from the store for each map.
  static constexpr double kSumStands_s = 10;

  MapQuota(auth::Gate& gate, MapRegistry& registry, auth::PassingTime now_s = auth::SystemPassingTime());

  /// A map that is being made. It counts as an existing one.
  class Making {
   public:
    Making(MapQuota& quota, std::string principal) : quota_(quota), principal_(std::move(principal)) {}
    ~Making() { quota_.GiveBack(principal_); }
    Making(const Making&) = delete;
    Making& operator=(const Making&) = delete;
    /// The map exists. If its owner cannot be stored, that is logged, and the map counts only until the next start.
    void Done(const MapSummary& map) { quota_.Note(principal_, map); }

   private:
    MapQuota& quota_;
    const std::string principal_;
  };
  /// RESOURCE_EXHAUSTED, reason OUT_OF_QUOTA, if the caller's maps have reached the number or the size allowed; null
  /// without keys. Reads from the store.
  Result<std::unique_ptr<Making>> Begin(const Caller& caller) DHPMAP_EXCLUDES(mutex_);
  /// The same check of the size, for the maker of `map`, before frames are added to it. OK while the store does not
  /// answer.
  Status CheckFeed(const MapInfo& map) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Sum {
    std::int64_t bytes = 0;
    double at_s = 0;
  };
  void GiveBack(const std::string& principal) DHPMAP_EXCLUDES(mutex_);
  void Note(const std::string& principal, const MapSummary& map) DHPMAP_EXCLUDES(mutex_);
  /// Removes entries of deleted maps once there may be many. Reads the list of all maps.
  Status ForgetGone() DHPMAP_EXCLUDES(mutex_);
  Status ForEachMap(const std::function<void(const MapInfo&)>& body) const;
  /// Reads the list of all maps.
  [[nodiscard]] Result<std::vector<std::string>> MapsOf(const std::string& principal) const;
  [[nodiscard]] bool HasRoom(const std::string& principal, std::size_t num_maps) DHPMAP_EXCLUDES(mutex_);
  Status CheckDisk(const std::string& principal) DHPMAP_EXCLUDES(mutex_);

  auth::Gate& gate_;
  MapRegistry& registry_;
  const auth::PassingTime now_s_;
  Mutex mutex_;
  std::map<std::string, int> num_making_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::string, Sum> sums_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t num_known_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< maps with an owner when last counted
};

}  // namespace dhpmap
