// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feeds/feed.h"

#include <new>
#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {
namespace {

/// The error for frames of a feed in this state.
Status RefusalOf(FeedState state) {
  switch (state) {
    case FeedState::kFeeding: return Status::Ok();
    case FeedState::kTakenOver:
      return Aborted("another stream has taken the map over: no more frames are taken from this one")
          .WithReason("FEED_TAKEN_OVER");
    case FeedState::kIdledOut:
      return Aborted("nothing came from this stream for so long that the map went to somebody else")
          .WithReason("FEED_IDLE");
    case FeedState::kEnded:
      return Aborted("the session was ended: no more frames are taken from this stream").WithReason("SESSION_ENDED");
    case FeedState::kMoved:
    case FeedState::kLeft: break;
  }
  return Aborted("this stream has left the map").WithReason("FEED_TAKEN_OVER");
}

}  // namespace

Status Feed::MayFeed() const {
  const MutexLock lock(mutex_);
  return state_.Is(FeedState::kMoved) ? CopyOf(moved_) : RefusalOf(state_.state());
}

void Feed::OnFrameBegun() {
  const MutexLock lock(mutex_);
  ++num_under_way_;
}

void Feed::OnFrameDone(Clock::time_point now) {
  const MutexLock lock(mutex_);
  --num_under_way_;
  last_active_ = now;
}

bool Feed::BeginsNow() {
  const MutexLock lock(mutex_);
  return !std::exchange(has_begun_, true);
}

Feed::Clock::time_point Feed::last_active() const {
  const MutexLock lock(mutex_);
  return last_active_;
}

bool Feed::IsIdle(Clock::time_point now, Clock::duration limit) const {
  const MutexLock lock(mutex_);
  return num_under_way_ == 0 && now - last_active_ >= limit;
}

void Feed::OnFused(std::int64_t frame_number, std::int64_t sequence) {
  const MutexLock lock(mutex_);
  if (unstored_.size() >= kMaxRemembered) unstored_.pop_back();
  try {
    unstored_.push_back({frame_number, sequence});
  } catch (const std::bad_alloc&) {
    if (!unstored_.empty()) unstored_.back() = {frame_number, sequence};
  }
}

std::optional<std::int64_t> Feed::StoredUpTo(std::int64_t num_stored_frames) {
  const MutexLock lock(mutex_);
  while (!unstored_.empty() && unstored_.front().number <= num_stored_frames) {
    stored_ = unstored_.front().sequence;
    unstored_.pop_front();
  }
  return stored_;
}

bool Feed::End(FeedState how, const Status& why) {
  const MutexLock lock(mutex_);
  if (!state_.Is(FeedState::kFeeding)) return false;
  moved_ = CopyOf(why);
  state_.To(how);
  return true;
}

void Feed::TellEvicted() const {
  if (request_.on_evicted) TellSafely([this] { request_.on_evicted(MayFeed()); });
}

}  // namespace dhpmap
