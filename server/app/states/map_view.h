// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "mapping/base/mutex.h"
#include "mapping/map/map.h"
#include "mapping/query/point_lookup.h"
#include "mapping/submap/observed_sphere.h"
#include "server/app/states/outline_cache.h"

namespace dhpmap {

/// A published state of a map with its index for point queries and other caches. Pins that state. Thread-safe.
class MapView {
 public:
  /// `before`: view of another state of the map, to derive the index from; null: none.
  explicit MapView(std::shared_ptr<const MapSnapshot> snapshot, const MapView* before = nullptr)
      : snapshot_(std::move(snapshot)),
        trail_(before == nullptr ? std::make_shared<IndexTrail>() : before->trail_),
        outlines_(before == nullptr ? std::make_shared<OutlineCache>() : before->outlines_) {}

  [[nodiscard]] const MapSnapshot& snapshot() const { return *snapshot_; }
  [[nodiscard]] const std::shared_ptr<const MapSnapshot>& shared_snapshot() const { return snapshot_; }

  /// Whether no other view of this chain of derived views exists. May change at any time.
  [[nodiscard]] bool IsOnlyOne() const { return trail_.use_count() == 1; }

  /// Built by the first caller; concurrent callers wait for it.
  [[nodiscard]] const PointLookup& lookup() const {
    const MutexLock lock(mutex_);
    if (!lookup_) lookup_.emplace(snapshot_, *trail_);
    return *lookup_;  // constant from now on
  }

  /// Cached SphereOfObservedInMap of one of the snapshot's submaps: it takes a millisecond for a wall, and planners
  /// request the same objects at 50 Hz while a state lasts some 0.2 s.
  [[nodiscard]] BoundingSphere ObservedSphereInMap(const Submap& submap) const {
    {
      const MutexLock lock(sphere_mutex_);
      if (const auto found = spheres_.find(submap.id()); found != spheres_.end()) return found->second;
    }
    const BoundingSphere sphere = SphereOfObservedInMap(submap);  // without the lock; computing it twice does no harm
    const MutexLock lock(sphere_mutex_);
    return spheres_.emplace(submap.id(), sphere).first->second;
  }

  /// OutlineInMap of one of the snapshot's submaps, cached over all states with the same voxels.
  [[nodiscard]] std::optional<SubmapOutline> OutlineInMap(const Submap& submap, OutlineCache::Reading reading) const {
    return outlines_->Find(submap, reading);
  }

 private:
  std::shared_ptr<const MapSnapshot> snapshot_;
  std::shared_ptr<IndexTrail> trail_;
  std::shared_ptr<OutlineCache> outlines_;  ///< shared by all derived views
  mutable Mutex mutex_;
  mutable std::optional<PointLookup> lookup_ DHPMAP_GUARDED_BY(mutex_);
  mutable Mutex sphere_mutex_;  // held briefly
  mutable std::map<SubmapId, BoundingSphere> spheres_ DHPMAP_GUARDED_BY(sphere_mutex_);
};

}  // namespace dhpmap
