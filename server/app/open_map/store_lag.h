// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Age of the oldest unstored frame. Tracks one frame at a time: the newest one at the moment when the previous one was
/// found stored, so it is exact within one round of commits. Thread-safe.
class StoreLag {
 public:
  using Clock = std::chrono::steady_clock;

  /// The map's frame number `num_frames` is fused. Numbers ascend.
  void OnFused(std::int64_t num_frames, Clock::time_point now) DHPMAP_EXCLUDES(mutex_);
  /// The first `num_stored` frames are stored.
  void OnStored(std::int64_t num_stored) DHPMAP_EXCLUDES(mutex_);

  /// 0 while everything is stored.
  [[nodiscard]] double Seconds(Clock::time_point now) const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Frame {
    std::int64_t number;
    Clock::time_point time;
  };

  mutable Mutex mutex_;
  std::optional<Frame> watched_ DHPMAP_GUARDED_BY(mutex_);
  std::optional<Frame> newest_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
