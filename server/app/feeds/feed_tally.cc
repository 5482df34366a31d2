// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feeds/feed_tally.h"

#include <algorithm>
#include <new>

namespace dhpmap {
namespace {

constexpr std::int64_t kRate_ns = FeedTally::kRate_s * 1'000'000'000;

}  // namespace

void FeedTally::OnMessage(std::size_t num_bytes, std::int64_t now_ns) {
  const MutexLock lock(mutex_);
  if (first_seen_ns_ == 0) first_seen_ns_ = now_ns;
  counts_.last_seen_ns = now_ns;
  counts_.num_bytes += static_cast<std::int64_t>(num_bytes);
}

void FeedTally::OnFused(std::int64_t sequence, std::int64_t num_points, std::int64_t now_ns,
                        const Transform& T_map_sensor) {
  const MutexLock lock(mutex_);
  path_.Add(T_map_sensor);
  ++counts_.num_fused;
  counts_.num_points += num_points;
  counts_.accepted_sequence = sequence;
  try {
    fused_ns_.push_back(now_ns);
  } catch (const std::bad_alloc&) {
    return;  // only the rate is affected
  }
  while (fused_ns_.size() > kMaxRemembered || fused_ns_.front() <= now_ns - kRate_ns) fused_ns_.pop_front();
}

void FeedTally::OnChecked(const std::vector<FrameWarning>& warnings) {
  const MutexLock lock(mutex_);
  if (warnings.empty()) {
    if (counts_.last_warning) ++counts_.num_plausible_since;
    return;
  }
  ++counts_.num_implausible;
  try {
    counts_.last_warning = warnings.front();
    counts_.num_plausible_since = 0;
  } catch (const std::bad_alloc&) {
    return;  // of the words alone
  }
}

void FeedTally::OnRefused() {
  const MutexLock lock(mutex_);
  ++counts_.num_refused;
}

void FeedTally::OnDuplicate() {
  const MutexLock lock(mutex_);
  ++counts_.num_duplicates;
}

std::int64_t FeedTally::last_seen_ns() const {
  const MutexLock lock(mutex_);
  return counts_.last_seen_ns;
}

FeedCounts FeedTally::Counts(std::int64_t now_ns) const {
  const MutexLock lock(mutex_);
  FeedCounts counts = counts_;
  const auto first = std::upper_bound(fused_ns_.begin(), fused_ns_.end(), now_ns - kRate_ns);
  const bool is_full = fused_ns_.size() == kMaxRemembered && first == fused_ns_.begin();
  const std::int64_t from_ns = is_full ? fused_ns_.front() : std::max(first_seen_ns_, now_ns - kRate_ns);
  const std::int64_t time_ns = std::max<std::int64_t>(now_ns - from_ns, 1'000'000'000);  // a shorter time gives no rate
  counts.frames_per_s = static_cast<double>(fused_ns_.end() - first) * 1e9 / static_cast<double>(time_ns);
  return counts;
}

SensorPath FeedTally::Path() const {
  const MutexLock lock(mutex_);
  return path_;
}

}  // namespace dhpmap
