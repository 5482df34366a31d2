// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "mapping/pipeline/map_builder.h"
#include "server/app/feeds/feed_tally.h"
#include "server/base/state_machine.h"

namespace dhpmap {

/// Where one client's turn at feeding a map stands.
enum class FeedState {
  kFeeding,    ///< its frames are taken
  kLeft,       ///< it went of itself
  kTakenOver,  ///< another stream has its place
  kIdledOut,   ///< it was silent for so long that somebody else got the map
  kEnded,      ///< somebody has ended its session
};

/// It ends once, one way or the other.
constexpr bool IsLegal(FeedState from, FeedState to) {
  return from == FeedState::kFeeding && to != FeedState::kFeeding;
}

/// What a client asks for that wants to feed a map.
struct FeedRequest {
  std::string session;     ///< the client's name for this session of frames; empty: none
  bool take_over = false;  ///< in place of all who feed the map now
  ImplausibleFrames implausible = ImplausibleFrames::kFuse;
  /// Called once if the feed has to end before it leaves: ABORTED, and why. On another thread, without locks.
  std::function<void(const Status&)> on_evicted = {};
};

/// One client's turn at feeding a map, from FeedSeats::Take until it leaves or another gets its place. Remembers which
/// of its frames are not known to be stored yet. Thread-safe.
class Feed {
 public:
  using Clock = std::chrono::steady_clock;
  /// Frames that are remembered one by one. Of more, and for want of memory, those before the last are told as stored
  /// when the last one is.
  static constexpr std::size_t kMaxRemembered = 1024;

  Feed(FeedRequest request, Clock::time_point now, std::shared_ptr<FeedTally> tally = std::make_shared<FeedTally>())
      : request_(std::move(request)), tally_(std::move(tally)), last_active_(now) {}

  /// Empty: none.
  [[nodiscard]] const std::string& session() const { return request_.session; }
  [[nodiscard]] ImplausibleFrames implausible() const { return request_.implausible; }
  /// That of its session, or of streams without one.
  [[nodiscard]] FeedTally& tally() const { return *tally_; }

  /// OK as long as its frames are taken; else what they are refused with.
  [[nodiscard]] Status MayFeed() const DHPMAP_EXCLUDES(mutex_);

  /// A frame of it is under way to the map, or has got there: as long as one is, it is not idle.
  void OnFrameBegun() DHPMAP_EXCLUDES(mutex_);
  void OnFrameDone(Clock::time_point now) DHPMAP_EXCLUDES(mutex_);
  /// True for the first call.
  [[nodiscard]] bool BeginsNow() DHPMAP_EXCLUDES(mutex_);
  /// When a frame of it was done last, or it began.
  [[nodiscard]] Clock::time_point last_active() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool IsIdle(Clock::time_point now, Clock::duration limit) const DHPMAP_EXCLUDES(mutex_);

  /// The client's frame `sequence` is fused, as the map's frame number `frame_number`, counted from 1. Does not throw.
  void OnFused(std::int64_t frame_number, std::int64_t sequence) DHPMAP_EXCLUDES(mutex_);
  /// The sequence of the newest frame of this feed among the first `num_stored_frames` of the map; nothing if none is.
  /// `num_stored_frames` does not fall from call to call.
  std::optional<std::int64_t> StoredUpTo(std::int64_t num_stored_frames) DHPMAP_EXCLUDES(mutex_);

  /// Ends it; the owner of the seat calls this. False if it had ended before.
  bool End(FeedState how) DHPMAP_EXCLUDES(mutex_);
  /// Tells the client's side why it was ended. Without locks.
  void TellEvicted() const;

 private:
  struct FusedFrame {
    std::int64_t number;
    std::int64_t sequence;
  };

  const FeedRequest request_;
  const std::shared_ptr<FeedTally> tally_;
  mutable Mutex mutex_;
  StateMachine<FeedState> state_ DHPMAP_GUARDED_BY(mutex_){FeedState::kFeeding};
  Clock::time_point last_active_ DHPMAP_GUARDED_BY(mutex_);
  int num_under_way_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool has_begun_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::deque<FusedFrame> unstored_ DHPMAP_GUARDED_BY(mutex_);  ///< by ascending number
  std::optional<std::int64_t> stored_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
