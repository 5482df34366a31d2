// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/failed_logins.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dhpmap::auth {

double FailedLogins::LeftAt(double now_s, const Bucket& bucket) {
  return std::min(kMost, bucket.left + kPer_s * (now_s - bucket.filled_s));
}

Status FailedLogins::Count(std::string_view address) {
  const double now_s = now_s_();
  const MutexLock lock(mutex_);
  auto found = buckets_.find(address);
  if (found == buckets_.end()) {
    if (buckets_.size() >= kMostAddresses) MakeRoom(now_s);
    found = buckets_.emplace(std::string(address), Bucket{.filled_s = now_s}).first;
  }
  Bucket& bucket = found->second;
  bucket = {.left = LeftAt(now_s, bucket), .filled_s = now_s};
  if (bucket.left < 1) {
    const std::string wait_s = std::to_string(static_cast<int>(std::ceil((1 - bucket.left) / kPer_s)));
    return ResourceExhausted("too many wrong keys came from this address: try again in " + wait_s + " s")
        .WithReason("TOO_MANY_LOGINS")
        .WithMetadata("retry_after_s", wait_s);
  }
  bucket.left -= 1;
  return Status::Ok();
}

void FailedLogins::MakeRoom(double now_s) {
  std::erase_if(buckets_, [now_s](const auto& entry) { return LeftAt(now_s, entry.second) >= kMost; });
  // So many addresses at once belong to one attacker, whom a limit by address does not stop anyway.
  if (buckets_.size() >= kMostAddresses) buckets_.clear();
}

std::size_t FailedLogins::num_addresses() const {
  const MutexLock lock(mutex_);
  return buckets_.size();
}

}  // namespace dhpmap::auth
