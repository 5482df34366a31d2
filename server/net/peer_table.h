// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>

#include "mapping/base/mutex.h"
#include "server/net/token_bucket.h"

namespace dhpmap::net {

/// The limits that all connections of one peer share. Thread-safe.
class PeerCounts {
 public:
  using Time = TokenBucket::Time;
  static constexpr double kResets = 1024, kResets_per_s = 132;
  static constexpr double kControl = 2000, kControl_per_s = 500;

  /// False if the peer's connections have exceeded the shared limit.
  bool TakeReset(Time now) DHPMAP_EXCLUDES(mutex_);
  bool TakeControl(Time now) DHPMAP_EXCLUDES(mutex_);

 private:
  friend class PeerTable;
  bool IsAtRest(Time now) DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  TokenBucket resets_ DHPMAP_GUARDED_BY(mutex_){kResets, kResets_per_s};
  TokenBucket control_ DHPMAP_GUARDED_BY(mutex_){kControl, kControl_per_s};
};

/// The peers with connections now or recently: a peer that reconnects keeps its counts. Thread-safe.
class PeerTable {
 public:
  using Time = TokenBucket::Time;

  explicit PeerTable(std::size_t max_connections_per_peer) : most_(max_connections_per_peer) {}

  /// Registers a connection until the result is released; null if the peer has reached its limit.
  std::shared_ptr<PeerCounts> Join(const std::string& key, Time now) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);

 private:
  /// Drops peers without connections whose limits have recovered.
  void Forget(Time now) DHPMAP_REQUIRES(mutex_);

  const std::size_t most_;
  mutable Mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<PeerCounts>> peers_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t forget_at_ DHPMAP_GUARDED_BY(mutex_) = 64;
};

}  // namespace dhpmap::net
