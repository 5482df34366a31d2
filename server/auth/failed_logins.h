// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/auth/call_limits.h"

namespace dhpmap::auth {

/// Limits wrong keys for each address: a burst of kMost, then kMost a minute. It locks nobody out: callers with a valid
/// key are not checked. It keeps at most kMostAddresses. When full, it drops addresses without recent failures; if
/// there are none, it drops all, and each may fail kMost times again. Thread-safe.
class FailedLogins {
 public:
  static constexpr double kMost = 20, kPer_s = kMost / 60;
  static constexpr std::size_t kMostAddresses = 4096;

  explicit FailedLogins(PassingTime now_s) : now_s_(std::move(now_s)) {}

  /// Counts one wrong key from this address. RESOURCE_EXHAUSTED, reason TOO_MANY_LOGINS, if there were too many before;
  /// the metadata `retry_after_s` say when to try again.
  Status Count(std::string_view address) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t num_addresses() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Bucket {
    double left = kMost;
    double filled_s = 0;
  };
  static double LeftAt(double now_s, const Bucket& bucket);
  void MakeRoom(double now_s) DHPMAP_REQUIRES(mutex_);

  const PassingTime now_s_;
  mutable Mutex mutex_;
  std::map<std::string, Bucket, std::less<>> buckets_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
