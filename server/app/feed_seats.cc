// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feed_seat.h"

#include <utility>

namespace dhpmap {

FeedSeat::FeedSeat(Clock::duration idle_limit, std::function<Clock::time_point()> now)
    : idle_limit_(idle_limit), now_(now ? std::move(now) : Clock::now) {}

Result<std::shared_ptr<Feed>> FeedSeat::Take(FeedRequest request) {
  std::shared_ptr<Feed> evicted, taken;
  {
    const MutexLock lock(mutex_);
    if (state_.Is(SeatState::kClosed)) return NotFound("the map is being deleted").WithReason("MAP_NOT_FOUND");
    if (state_.Is(SeatState::kTaken)) {
      const bool is_same_client = !request.session.empty() && request.session == feed_->session();
      if (request.take_over || is_same_client) evicted = Evict(FeedState::kTakenOver);
      else if (IsIdle()) evicted = Evict(FeedState::kIdledOut);
      else
        return Aborted("another stream feeds this map already: wait for its end, or take over")
            .WithReason("MAP_IS_FED");
    }
    taken = std::make_shared<Feed>(std::move(request), now_());
    state_.To(SeatState::kTaken);
    feed_ = taken;
  }
  if (evicted) evicted->TellEvicted();
  return taken;
}

void FeedSeat::Leave(const std::shared_ptr<Feed>& feed) {
  const MutexLock lock(mutex_);
  if (feed_ == feed) (void)Evict(FeedState::kLeft);
}

Status FeedSeat::Close() {
  std::shared_ptr<Feed> evicted;
  {
    const MutexLock lock(mutex_);
    if (state_.Is(SeatState::kClosed)) return NotFound("the map is being deleted").WithReason("MAP_NOT_FOUND");
    if (state_.Is(SeatState::kTaken)) {
      if (!IsIdle()) return FailedPrecondition("frames are being streamed into this map").WithReason("MAP_IS_FED");
      evicted = Evict(FeedState::kIdledOut);
    }
    state_.To(SeatState::kClosed);
  }
  if (evicted) evicted->TellEvicted();
  return Status::Ok();
}

void FeedSeat::Reopen() {
  const MutexLock lock(mutex_);
  state_.To(SeatState::kFree);
}

bool FeedSeat::IsIdle() const { return feed_->IsIdle(now_(), idle_limit_); }

std::shared_ptr<Feed> FeedSeat::Evict(FeedState how) {
  (void)feed_->End(how);
  state_.To(SeatState::kFree);
  return std::exchange(feed_, nullptr);
}

}  // namespace dhpmap
