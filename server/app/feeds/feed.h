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

/// State of a client's feed of a map.
enum class FeedState {
  kFeeding,    ///< frames are accepted
  kLeft,       ///< the client ended it
  kTakenOver,  ///< another stream has replaced it
  kIdledOut,   ///< replaced after silence of idle_s
  kEnded,      ///< its session was ended by request
  kMoved,      ///< another process writes the map now
};

/// A feed ends once.
constexpr bool IsLegal(FeedState from, FeedState to) {
  return from == FeedState::kFeeding && to != FeedState::kFeeding;
}

/// A client's request to feed a map.
struct FeedRequest {
  std::string session;     ///< the client's name of the feed session; may be empty
  bool take_over = false;  ///< replaces all present feeds of the map
  ImplausibleFrames implausible = ImplausibleFrames::kFuse;
  /// Called once if the feed is ended by the server: ABORTED, with a reason, or why the map has moved. On another
  /// thread, without locks.
  std::function<void(const Status&)> on_evicted = {};
};

/// A client's feed of a map, from FeedSeats::Take until it leaves or is replaced. Remembers its frames that are not
/// stored yet. Thread-safe.
class Feed {
 public:
  using Clock = std::chrono::steady_clock;
  /// Limit of individually remembered frames. Beyond it, or if memory runs out, earlier ones are reported as stored
  /// together with the last.
  static constexpr std::size_t kMaxRemembered = 1024;

  Feed(FeedRequest request, Clock::time_point now, std::shared_ptr<FeedTally> tally = std::make_shared<FeedTally>())
      : request_(std::move(request)), tally_(std::move(tally)), last_active_(now) {}

  /// May be empty.
  [[nodiscard]] const std::string& session() const { return request_.session; }
  [[nodiscard]] ImplausibleFrames implausible() const { return request_.implausible; }
  /// Of its session, or of streams without one.
  [[nodiscard]] FeedTally& tally() const { return *tally_; }

  /// OK while its frames are accepted; else the error for them.
  [[nodiscard]] Status MayFeed() const DHPMAP_EXCLUDES(mutex_);

  /// A frame of it is in flight or done: while one is in flight, the feed is not idle.
  void OnFrameBegun() DHPMAP_EXCLUDES(mutex_);
  void OnFrameDone(Clock::time_point now) DHPMAP_EXCLUDES(mutex_);
  /// True for the first call.
  [[nodiscard]] bool BeginsNow() DHPMAP_EXCLUDES(mutex_);
  /// Time of its last completed frame, or of its start.
  [[nodiscard]] Clock::time_point last_active() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool IsIdle(Clock::time_point now, Clock::duration limit) const DHPMAP_EXCLUDES(mutex_);

  /// The client's frame `sequence` is fused as the map's frame `frame_number`, counted from 1. Does not throw.
  void OnFused(std::int64_t frame_number, std::int64_t sequence) DHPMAP_EXCLUDES(mutex_);
  /// The sequence of this feed's newest frame among the first `num_stored_frames` of the map; nothing if there is none.
  /// `num_stored_frames` never decreases between calls.
  std::optional<std::int64_t> StoredUpTo(std::int64_t num_stored_frames) DHPMAP_EXCLUDES(mutex_);

  /// Ends it; only FeedSeats calls this. False if it had ended before. `why`: of kMoved.
  bool End(FeedState how, const Status& why = {}) DHPMAP_EXCLUDES(mutex_);
  /// Tells the client why it was ended. Without locks.
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
  Status moved_ DHPMAP_GUARDED_BY(mutex_);  ///< why, if it has
  Clock::time_point last_active_ DHPMAP_GUARDED_BY(mutex_);
  int num_under_way_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool has_begun_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::deque<FusedFrame> unstored_ DHPMAP_GUARDED_BY(mutex_);  ///< by ascending number
  std::optional<std::int64_t> stored_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
