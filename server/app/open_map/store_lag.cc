// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/store_lag.h"

namespace dhpmap {

void StoreLag::OnFused(std::int64_t num_frames, Clock::time_point now) {
  const MutexLock lock(mutex_);
  newest_ = Frame{num_frames, now};
  if (!watched_) watched_ = newest_;
}

void StoreLag::OnStored(std::int64_t num_stored) {
  const MutexLock lock(mutex_);
  if (!watched_ || watched_->number > num_stored) return;
  watched_ = newest_->number > num_stored ? newest_ : std::nullopt;
}

double StoreLag::Seconds(Clock::time_point now) const {
  const MutexLock lock(mutex_);
  return watched_ ? std::chrono::duration<double>(now - watched_->time).count() : 0.0;
}

}  // namespace dhpmap
