// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/mutex.h"
#include "mapping/map/map.h"
#include "storage/store.h"

namespace dhpmap {

/// The numbers of a map that may be shown before they are stored (see MapStore::Reserve): reserved in steps, each of
/// which costs one full sync. Thread-safe.
class NumberReserve {
 public:
  /// After an unclean end up to so many numbers are left out. Half of them are more than any map uses from one commit
  /// to the next: a busy scene makes, and dissolves, one or two things a frame.
  static constexpr std::int64_t kRevisionsAStep = 1000;
  static constexpr std::uint32_t kIdsAStep = 1000;

  /// `stored`: how far the store's state goes.
  NumberReserve(MapStore& store, const NumberMarks& stored) : store_(store), used_(stored), marks_(stored) {}

  /// Before `info` is shown to anyone: its numbers are reserved. Waits for the store only if they were not yet. On
  /// error it must not be shown.
  Status Cover(const MapInfo& info) DHPMAP_EXCLUDES(store_mutex_, mutex_);
  /// Reserves the next step if half of the last one is used, so that Cover seldom waits: for a thread that does not
  /// mind. On error nothing has changed; the next call tries again.
  void GoAhead(const std::string& map) DHPMAP_EXCLUDES(store_mutex_, mutex_);
  /// After a clean end, when `info` is stored: numbering goes on without a gap. Not while other calls are under way.
  void Release(const MapInfo& info) DHPMAP_EXCLUDES(store_mutex_, mutex_);

 private:
  [[nodiscard]] bool Covers(const MapInfo& info) const DHPMAP_EXCLUDES(mutex_);
  /// A step above what is used.
  Status Reserve(const std::string& map) DHPMAP_REQUIRES(store_mutex_) DHPMAP_EXCLUDES(mutex_);

  MapStore& store_;
  mutable Mutex mutex_;                               // never held for long
  Mutex store_mutex_ DHPMAP_ACQUIRED_BEFORE(mutex_);  // while the store writes: marks_ is never above what it has
  NumberMarks used_ DHPMAP_GUARDED_BY(mutex_);
  NumberMarks marks_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
