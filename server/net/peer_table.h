// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>

#include "mapping/base/mutex.h"
#include "server/net/token_bucket.h"

namespace dhpmap::net {

/// What all connections of one peer do together. Thread-safe.
class PeerCounts {
 public:
  using Time = TokenBucket::Time;
  static constexpr double kResets = 1024, kResets_per_s = 132;
  static constexpr double kControl = 2000, kControl_per_s = 500;

  /// False if the peer's connections have done more of it than they may.
  bool TakeReset(Time now) DHPMAP_EXCLUDES(mutex_);
  bool TakeControl(Time now) DHPMAP_EXCLUDES(mutex_);

 private:
  friend class PeerTable;
  bool IsAtRest(Time now) DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  TokenBucket resets_ DHPMAP_GUARDED_BY(mutex_){kResets, kResets_per_s};
  TokenBucket control_ DHPMAP_GUARDED_BY(mutex_){kControl, kControl_per_s};
};

/// The peers that have connections, or had them lately: who connects again does not begin anew. Thread-safe.
class PeerTable {
 public:
  using Time = TokenBucket::Time;

  explicit PeerTable(std::size_t max_connections_per_peer) : most_(max_connections_per_peer) {}

  /// One more connection, for as long as what is returned is held; null if the peer has as many as it may.
  std::shared_ptr<PeerCounts> Join(const std::string& key, Time now) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);

 private:
  /// Of those without connections that have been at rest.
  void Forget(Time now) DHPMAP_REQUIRES(mutex_);

  const std::size_t most_;
  mutable Mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<PeerCounts>> peers_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t forget_at_ DHPMAP_GUARDED_BY(mutex_) = 64;
};

}  // namespace dhpmap::net
