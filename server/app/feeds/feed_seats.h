// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/app/feeds/feed.h"

namespace dhpmap {

/// The active feeds of a map, and admission of new ones. Several named sessions may feed at once; a stream without a
/// name feeds alone, because it may be a second client started by mistake. Thread-safe.
class FeedSeats {
 public:
  using Clock = Feed::Clock;
  /// Limit of tallies kept for ended sessions; the least recently used is dropped.
  static constexpr std::size_t kMostTallies = 256;

  /// A feed that is silent for `idle_limit` may be replaced; at most `max_feeds` are active. `now` is for tests; empty:
  /// the steady clock.
  FeedSeats(Clock::duration idle_limit, std::size_t max_feeds, std::function<Clock::time_point()> now = {});

  /// ABORTED, reason MAP_IS_FED, if an active feed or this one has no name, unless the active one is idle. A feed ends
  /// for a request with take_over, and for one of its own session: that is the same client on a new connection.
  /// RESOURCE_EXHAUSTED, reason TOO_MANY_FEEDS, if max_feeds are active and none is idle.
  Result<std::shared_ptr<Feed>> Take(FeedRequest request) DHPMAP_EXCLUDES(mutex_);
  /// Ends the feed; no effect if it was replaced before.
  void Leave(const std::shared_ptr<Feed>& feed) DHPMAP_EXCLUDES(mutex_);
  /// Ends the feed of the session; empty: the unnamed one. NOT_FOUND, reason SESSION_NOT_FOUND, if there is none.
  Status End(const std::string& session) DHPMAP_EXCLUDES(mutex_);

  /// Ends all feeds with `why`, and admits no more: another process writes the map.
  void MoveAway(const Status& why) DHPMAP_EXCLUDES(mutex_);

  /// Admits no feed until Reopen. FAILED_PRECONDITION, reason MAP_IS_FED, if one is active and not idle.
  Status Close() DHPMAP_EXCLUDES(mutex_);
  void Reopen() DHPMAP_EXCLUDES(mutex_);

  /// The active feeds.
  [[nodiscard]] std::vector<std::shared_ptr<Feed>> Feeds() const DHPMAP_EXCLUDES(mutex_);
  /// Of recent sessions, by name.
  [[nodiscard]] std::map<std::string, std::shared_ptr<FeedTally>> Tallies() const DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] Clock::time_point Now() const { return now_(); }
  [[nodiscard]] Clock::duration idle_limit() const { return idle_limit_; }

 private:
  /// The feeds that `request` replaces, with their end states; or the error of refusing it.
  struct Eviction {
    std::shared_ptr<Feed> feed;
    FeedState how;
  };
  Result<std::vector<Eviction>> EvictionsFor(const FeedRequest& request) const DHPMAP_REQUIRES(mutex_);
  [[nodiscard]] bool IsIdle(const Feed& feed) const { return feed.IsIdle(now_(), idle_limit_); }
  void Evict(const std::vector<Eviction>& evictions) DHPMAP_REQUIRES(mutex_);
  std::shared_ptr<FeedTally> FindOrAddTally(const std::string& session) DHPMAP_REQUIRES(mutex_);

  const Clock::duration idle_limit_;
  const std::size_t max_feeds_;
  const std::function<Clock::time_point()> now_;
  mutable Mutex mutex_;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< the map is being deleted, or has been
  Status moved_ DHPMAP_GUARDED_BY(mutex_);            ///< not OK: see MoveAway
  std::vector<std::shared_ptr<Feed>> feeds_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::string, std::shared_ptr<FeedTally>> tallies_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
