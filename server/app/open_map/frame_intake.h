// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/pipeline/map_builder.h"
#include "server/app/feeds/feed_seats.h"
#include "server/app/feeds/session_list.h"
#include "server/app/open_map/map_writer.h"

namespace dhpmap {

struct FeedOptions {
  double idle_s = 30;          ///< silence after which a feed may be replaced
  std::size_t max_feeds = 16;  ///< concurrent feeds of a map
};

/// Result of a frame.
struct FrameOutcome {
  Result<FrameReport> report;  ///< or why the frame was refused; the map is then unchanged
  std::int64_t revision = 0;   ///< last published revision
  bool is_committed = false;   ///< everything up to this frame is stored
  Status commit_status;        ///< why the store is behind, if the last commit failed
  FrameCheck check = {};       ///< plausibility of the frame, refused or not; empty if it was not checked
  bool is_duplicate = false;   ///< already accepted in its session: no effect, and the report is empty
  std::optional<std::int64_t> committed_sequence = std::nullopt;  ///< see FeedProgress
};

/// A received frame of a feed.
struct ArrivedFrame {
  std::int64_t sequence = 0;    ///< the client's number
  Result<PanopticFrame> frame;  ///< or why it is invalid: reported in its turn, so that answers keep their order
  std::size_t num_bytes = 0;    ///< of the message
  std::string message = {};     ///< the message itself, if MapRecording::is_wanted
};

/// Progress of a feed.
struct FeedProgress {
  std::int64_t revision = 0;  ///< last published revision
  /// Of the newest frame that is stored together with all earlier ones: of the feed session, or of a feed without one.
  std::optional<std::int64_t> committed_sequence;
  Status commit_status;  ///< why the store is behind, if the last commit failed
};

/// Accepts the frames of a map's feeds and queues them for the writer in order of arrival. Thread-safe.
class FrameIntake {
 public:
  using OnRefinement = std::function<void(const RefinementReport&)>;

  /// `on_refinement` (may be empty) is called on the writer thread for refinements merged with a frame.
  FrameIntake(MapWriter writer, const FeedOptions& options, OnRefinement on_refinement);

  /// See FeedSeats::Take; INVALID_ARGUMENT for a bad session name, and the queue's error while it refuses work.
  Result<std::shared_ptr<Feed>> BeginFeed(FeedRequest request);
  [[nodiscard]] FeedSeats& seats() { return seats_; }
  [[nodiscard]] const FeedSeats& seats() const { return seats_; }
  /// See ListSessions.
  [[nodiscard]] std::vector<SessionStatus> Sessions() const;

  /// See OpenMap::Integrate. `feed` may be null: a single, unnamed feed.
  void Integrate(const std::shared_ptr<Feed>& feed, ArrivedFrame arrived, std::function<void(FrameOutcome)> done);
  /// Reports the feed's progress, in turn with its frames.
  void Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done);
  /// The same immediately.
  [[nodiscard]] FeedProgress ProgressOf(const std::shared_ptr<Feed>& feed) const;

 private:
  struct Arrival;
  FrameOutcome IntegrateNow(Arrival& arrival);
  Result<FrameReport> TakeInTurn(Arrival& arrival, bool& is_duplicate);
  Result<FrameReport> TakeFrame(Arrival& arrival);
  Result<FrameReport> Fuse(Feed* feed, std::int64_t sequence, const PanopticFrame& frame);
  void OnFused(Feed* feed, std::int64_t sequence, std::int64_t now_ns, const PanopticFrame& frame,
               const FrameReport& report);

  const MapWriter writer_;
  const OnRefinement on_refinement_;
  FeedSeats seats_;
};

}  // namespace dhpmap
