// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feeds/feed_seats.h"

#include <algorithm>
#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {
namespace {

Status MapIsFed(bool is_named) {
  return Aborted(is_named ? "a stream without a session feeds this map: wait for its end, or take over"
                          : "another stream feeds this map already: wait for its end, or take over; streams that name "
                            "their sessions may feed beside each other")
      .WithReason("MAP_IS_FED");
}

Status TooManyFeeds(std::size_t max_feeds) {
  return ResourceExhausted(std::to_string(max_feeds) + " streams feed this map: no more may do so at once")
      .WithReason("TOO_MANY_FEEDS");
}

Status MapIsGone() { return NotFound("the map is being deleted").WithReason("MAP_NOT_FOUND"); }

}  // namespace

FeedSeats::FeedSeats(Clock::duration idle_limit, std::size_t max_feeds, std::function<Clock::time_point()> now)
    : idle_limit_(idle_limit), max_feeds_(max_feeds), now_(now ? std::move(now) : Clock::now) {}

Result<std::shared_ptr<Feed>> FeedSeats::Take(FeedRequest request) {
  std::vector<Eviction> evictions;
  std::shared_ptr<Feed> taken;
  {
    const MutexLock lock(mutex_);
    DHPMAP_RETURN_IF_ERROR(CopyOf(moved_));
    if (is_closed_) return MapIsGone();
    DHPMAP_ASSIGN_OR_RETURN(evictions, EvictionsFor(request));
    Evict(evictions);
    auto tally = FindOrAddTally(request.session);
    taken = std::make_shared<Feed>(std::move(request), now_(), std::move(tally));
    feeds_.push_back(taken);
  }
  for (const Eviction& eviction : evictions) eviction.feed->TellEvicted();
  return taken;
}

Result<std::vector<FeedSeats::Eviction>> FeedSeats::EvictionsFor(const FeedRequest& request) const {
  const bool is_named = !request.session.empty();
  std::vector<Eviction> evictions;
  std::shared_ptr<Feed> idlest;
  for (const auto& feed : feeds_) {
    const bool is_same_client = is_named && request.session == feed->session();
    if (request.take_over || is_same_client) {
      evictions.push_back({feed, FeedState::kTakenOver});
    } else if (is_named && !feed->session().empty()) {  // named sessions feed concurrently
      if (IsIdle(*feed) && (idlest == nullptr || feed->last_active() < idlest->last_active())) idlest = feed;
    } else if (IsIdle(*feed)) {
      evictions.push_back({feed, FeedState::kIdledOut});
    } else {
      return MapIsFed(is_named);
    }
  }
  if (feeds_.size() - evictions.size() < max_feeds_) return evictions;
  if (idlest == nullptr) return TooManyFeeds(max_feeds_);
  evictions.push_back({idlest, FeedState::kIdledOut});
  return evictions;
}

void FeedSeats::Evict(const std::vector<Eviction>& evictions) {
  for (const Eviction& eviction : evictions) {
    (void)eviction.feed->End(eviction.how);
    std::erase(feeds_, eviction.feed);
  }
}

void FeedSeats::Leave(const std::shared_ptr<Feed>& feed) {
  const MutexLock lock(mutex_);
  if (std::erase(feeds_, feed) > 0) (void)feed->End(FeedState::kLeft);
}

Status FeedSeats::End(const std::string& session) {
  std::shared_ptr<Feed> ended;
  {
    const MutexLock lock(mutex_);
    const auto found =
        std::find_if(feeds_.begin(), feeds_.end(), [&](const auto& feed) { return feed->session() == session; });
    if (found == feeds_.end()) {
      return NotFound("no stream feeds the map " + (session.empty() ? "without a session" : "as '" + session + "'"))
          .WithReason("SESSION_NOT_FOUND");
    }
    ended = *found;
    Evict({{ended, FeedState::kEnded}});
  }
  ended->TellEvicted();
  return Status::Ok();
}

void FeedSeats::MoveAway(const Status& why) {
  std::vector<std::shared_ptr<Feed>> ended;
  {
    const MutexLock lock(mutex_);
    moved_ = CopyOf(why);
    ended.swap(feeds_);
    for (const auto& feed : ended) (void)feed->End(FeedState::kMoved, why);
  }
  for (const auto& feed : ended) feed->TellEvicted();
}

Status FeedSeats::Close() {
  std::vector<Eviction> evictions;
  {
    const MutexLock lock(mutex_);
    if (is_closed_) return MapIsGone();
    for (const auto& feed : feeds_) {
      if (!IsIdle(*feed)) return FailedPrecondition("frames are being streamed into this map").WithReason("MAP_IS_FED");
      evictions.push_back({feed, FeedState::kIdledOut});
    }
    Evict(evictions);
    is_closed_ = true;
  }
  for (const Eviction& eviction : evictions) eviction.feed->TellEvicted();
  return Status::Ok();
}

void FeedSeats::Reopen() {
  const MutexLock lock(mutex_);
  is_closed_ = false;
}

std::vector<std::shared_ptr<Feed>> FeedSeats::Feeds() const {
  const MutexLock lock(mutex_);
  return feeds_;
}

std::map<std::string, std::shared_ptr<FeedTally>> FeedSeats::Tallies() const {
  const MutexLock lock(mutex_);
  return tallies_;
}

std::shared_ptr<FeedTally> FeedSeats::FindOrAddTally(const std::string& session) {
  if (const auto found = tallies_.find(session); found != tallies_.end()) return found->second;
  if (tallies_.size() >= std::max(kMostTallies, max_feeds_)) {  // keep those of feeds, which are still updated
    tallies_.erase(std::min_element(tallies_.begin(), tallies_.end(), [](const auto& a, const auto& b) {
      return a.second->last_seen_ns() < b.second->last_seen_ns();
    }));
  }
  return tallies_.emplace(session, std::make_shared<FeedTally>()).first->second;
}

}  // namespace dhpmap
