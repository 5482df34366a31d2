// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/mutex.h"
#include "mapping/map/map.h"
#include "storage/store.h"

namespace dhpmap {

/// Reserves the numbers of a map that become visible before they are stored (see MapStore::Reserve), in steps of one
/// full sync each. Thread-safe.
class NumberReserve {
 public:
  /// Size of a step; after a crash up to this many numbers are skipped. Half a step exceeds the use between two
  /// commits: a busy scene creates and dissolves one or two things per frame.
  static constexpr std::int64_t kRevisionsAStep = 1000;
  static constexpr std::uint32_t kIdsAStep = 1000;

  /// `stored`: numbers of the stored state.
  NumberReserve(MapStore& store, const NumberMarks& stored) : store_(store), used_(stored), marks_(stored) {}

  /// Call before `info` becomes visible: reserves its numbers. Waits for the store only if they were not reserved yet.
  /// On error it must not become visible.
  Status Cover(const MapInfo& info) DHPMAP_EXCLUDES(store_mutex_, mutex_);
  /// Reserves the next step if half of the last one is used, so that Cover rarely waits: for a thread that may block.
  /// On error nothing has changed; the next call tries again.
  void GoAhead(const std::string& map) DHPMAP_EXCLUDES(store_mutex_, mutex_);
  /// After a clean shutdown with `info` stored: numbers continue without a gap. Not concurrently with other calls.
  void Release(const MapInfo& info) DHPMAP_EXCLUDES(store_mutex_, mutex_);

 private:
  [[nodiscard]] bool Covers(const MapInfo& info) const DHPMAP_EXCLUDES(mutex_);
  /// Reserves a step above the used numbers.
  Status Reserve(const std::string& map) DHPMAP_REQUIRES(store_mutex_) DHPMAP_EXCLUDES(mutex_);

  MapStore& store_;
  mutable Mutex mutex_;  // held briefly
  Mutex store_mutex_
      DHPMAP_ACQUIRED_BEFORE(mutex_);  // held during writes of the store: marks_ never exceeds the stored marks
  NumberMarks used_ DHPMAP_GUARDED_BY(mutex_);
  NumberMarks marks_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
