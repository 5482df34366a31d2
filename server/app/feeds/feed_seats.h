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

/// The feeders of a map: who has a place among them, and who gets one. Several sessions with names may feed at once; a
/// stream without a name is alone, as nobody can tell it from another client that was started by mistake. Thread-safe.
class FeedSeats {
 public:
  using Clock = Feed::Clock;
  /// Tallies of sessions that have left which are kept; the one that was heard of longest ago goes.
  static constexpr std::size_t kMostTallies = 256;

  /// A feeder that is silent for `idle_limit` makes place for others; there are at most `max_feeds`. `now` is for
  /// tests; empty: the steady clock.
  FeedSeats(Clock::duration idle_limit, std::size_t max_feeds, std::function<Clock::time_point()> now = {});

  /// ABORTED, reason MAP_IS_FED, if one feeds who is not idle and one of both has no name. A feed ends for one that
  /// takes over, whatever its name, and for its own session: that is the same client, come back over another
  /// connection. RESOURCE_EXHAUSTED, reason TOO_MANY_FEEDS, if there are so many, of which none is idle.
  Result<std::shared_ptr<Feed>> Take(FeedRequest request) DHPMAP_EXCLUDES(mutex_);
  /// The feed is over; nothing happens if it has lost its place before.
  void Leave(const std::shared_ptr<Feed>& feed) DHPMAP_EXCLUDES(mutex_);
  /// Ends the feed of the session; empty: the one without a name. NOT_FOUND, reason SESSION_NOT_FOUND, if there is
  /// none.
  Status End(const std::string& session) DHPMAP_EXCLUDES(mutex_);

  /// Lets nobody in until Reopen. FAILED_PRECONDITION, reason MAP_IS_FED, if one feeds who is not idle.
  Status Close() DHPMAP_EXCLUDES(mutex_);
  void Reopen() DHPMAP_EXCLUDES(mutex_);

  /// Who feeds now.
  [[nodiscard]] std::vector<std::shared_ptr<Feed>> Feeds() const DHPMAP_EXCLUDES(mutex_);
  /// Of the sessions that were heard of lately, by name.
  [[nodiscard]] std::map<std::string, std::shared_ptr<FeedTally>> Tallies() const DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] Clock::time_point Now() const { return now_(); }
  [[nodiscard]] Clock::duration idle_limit() const { return idle_limit_; }

 private:
  /// Which feeds are in the way of `request`, and how each ends for it; or why it has to wait.
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
  std::vector<std::shared_ptr<Feed>> feeds_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::string, std::shared_ptr<FeedTally>> tallies_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
