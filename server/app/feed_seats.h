// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "mapping/base/state_machine.h"
#include "server/app/feed.h"

namespace dhpmap {

/// Who may feed a map.
enum class SeatState {
  kFree,
  kTaken,   ///< a feed has it
  kClosed,  ///< nobody may have it: the map is being deleted, or has been
};

constexpr bool IsLegal(SeatState from, SeatState to) {
  switch (from) {
    case SeatState::kFree: return to == SeatState::kTaken || to == SeatState::kClosed;
    case SeatState::kTaken:  // whoever comes next finds it free
    case SeatState::kClosed: return to == SeatState::kFree;
  }
  return false;
}

/// The one place of a feeder at a map: who has it, and who gets it. Thread-safe.
class FeedSeat {
 public:
  using Clock = Feed::Clock;

  /// A feeder that is silent for `idle_limit` makes place for others. `now` is for tests; empty: the steady clock.
  explicit FeedSeat(Clock::duration idle_limit, std::function<Clock::time_point()> now = {});

  /// ABORTED, reason MAP_IS_FED, if another feed has it who is not idle. It makes place all the same for one that takes
  /// over, and for its own session: that is the same client, come back over another connection.
  Result<std::shared_ptr<Feed>> Take(FeedRequest request) DHPMAP_EXCLUDES(mutex_);
  /// The feed is over; nothing happens if it has lost its place before.
  void Leave(const std::shared_ptr<Feed>& feed) DHPMAP_EXCLUDES(mutex_);

  /// Lets nobody in until Reopen. FAILED_PRECONDITION, reason MAP_IS_FED, if a feed has it who is not idle.
  Status Close() DHPMAP_EXCLUDES(mutex_);
  void Reopen() DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] Clock::time_point Now() const { return now_(); }

 private:
  [[nodiscard]] bool IsIdle() const DHPMAP_REQUIRES(mutex_);
  /// Ends the feed that has it and returns it, to be told without the lock.
  std::shared_ptr<Feed> Evict(FeedState how) DHPMAP_REQUIRES(mutex_);

  const Clock::duration idle_limit_;
  const std::function<Clock::time_point()> now_;
  Mutex mutex_;
  StateMachine<SeatState> state_ DHPMAP_GUARDED_BY(mutex_){SeatState::kFree};
  std::shared_ptr<Feed> feed_ DHPMAP_GUARDED_BY(mutex_);  ///< while taken
};

}  // namespace dhpmap
