// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "mapping/base/mutex.h"
#include "mapping/map/map.h"
#include "mapping/query/point_lookup.h"

namespace dhpmap {

/// A published state of a map with its index for point queries. Holding it keeps that state alive. Thread-safe.
class MapView {
 public:
  explicit MapView(std::shared_ptr<const MapSnapshot> snapshot) : snapshot_(std::move(snapshot)) {}

  [[nodiscard]] const MapSnapshot& snapshot() const { return *snapshot_; }
  [[nodiscard]] const std::shared_ptr<const MapSnapshot>& shared_snapshot() const { return snapshot_; }

  /// Built by the first caller; others that come meanwhile wait for it.
  [[nodiscard]] const PointLookup& lookup() const {
    const MutexLock lock(mutex_);
    if (!lookup_) lookup_.emplace(snapshot_);
    return *lookup_;  // stays as it is from now on
  }

 private:
  std::shared_ptr<const MapSnapshot> snapshot_;
  mutable Mutex mutex_;
  mutable std::optional<PointLookup> lookup_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
