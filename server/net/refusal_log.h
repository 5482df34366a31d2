// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "mapping/base/mutex.h"
#include "server/net/peer_identity.h"
#include "server/net/refusal.h"
#include "server/net/token_bucket.h"

namespace dhpmap::net {

/// Reports refused and ended connections: each one to `on_refused`, and to the log at a readable rate, with the number
/// of those left out. Thread-safe.
class RefusalLog {
 public:
  RefusalLog(std::string door, std::function<void(Refusal)> on_refused)
      : door_(std::move(door)), on_refused_(std::move(on_refused)) {}

  void Note(Refusal why, const PeerIdentity& peer) DHPMAP_EXCLUDES(mutex_);

 private:
  const std::string door_;
  const std::function<void(Refusal)> on_refused_;
  Mutex mutex_;
  TokenBucket lines_ DHPMAP_GUARDED_BY(mutex_){20, 1};
  std::uint64_t num_untold_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap::net
