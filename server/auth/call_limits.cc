// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/call_limits.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dhpmap::auth {

PassingTime SystemPassingTime() {
  return [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
}

Status CallRates::Count(std::string_view principal) {
  const double now_s = now_s_();
  const MutexLock lock(mutex_);
  auto found = buckets_.find(principal);
  if (found == buckets_.end()) {
    found = buckets_.emplace(std::string(principal), Bucket{limits_.burst_calls, now_s}).first;
  }
  Bucket& bucket = found->second;
  bucket.left = std::min(limits_.burst_calls, bucket.left + limits_.calls_per_s * (now_s - bucket.filled_s));
  bucket.filled_s = now_s;
  if (bucket.left < 1) {
    std::string text = "'";  // in steps: GCC 12 warns wrongly about "'" + std::string(...)
    text.append(principal).append("' calls more often than one may: try again later");
    return ResourceExhausted(std::move(text)).WithReason("OUT_OF_QUOTA").WithMetadata("retry_after_s", "1");
  }
  bucket.left -= 1;
  return Status::Ok();
}

}  // namespace dhpmap::auth
