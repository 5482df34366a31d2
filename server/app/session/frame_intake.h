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
#include "server/app/session/map_writer.h"

namespace dhpmap {

struct FeedOptions {
  double idle_s = 30;          ///< a feeder that is silent for so long makes place for others
  std::size_t max_feeds = 16;  ///< streams that feed a map at once
};

/// What became of a frame.
struct FrameOutcome {
  Result<FrameReport> report;  ///< or why the frame was refused: then it changed nothing
  std::int64_t revision = 0;   ///< last published
  bool is_committed = false;   ///< everything up to this frame is in the store
  Status commit_status;        ///< why the store is behind, if the last commit failed
  FrameCheck check = {};       ///< how the frame fits, refused or not; empty if it was not looked at
  bool is_duplicate = false;   ///< of one that its session had taken before: changed nothing, and the report is empty
  std::optional<std::int64_t> committed_sequence = std::nullopt;  ///< see FeedProgress
};

/// A frame of a feed, as it came.
struct ArrivedFrame {
  std::int64_t sequence = 0;    ///< the client's number
  Result<PanopticFrame> frame;  ///< or why it cannot be used: passed on in its turn, so that answers keep their order
  std::size_t num_bytes = 0;    ///< of the message
  std::string message = {};     ///< itself, if MapRecording::is_wanted
};

/// How far a feed has got.
struct FeedProgress {
  std::int64_t revision = 0;  ///< last published
  /// Of the newest frame that is in the store together with all before it: of the session, or of a feed without one.
  std::optional<std::int64_t> committed_sequence;
  Status commit_status;  ///< why the store is behind, if the last commit failed
};

/// Takes the frames of a map's feeds and has the writer fuse them, in the order in which they come. Thread-safe.
class FrameIntake {
 public:
  using OnRefinement = std::function<void(const RefinementReport&)>;

  /// `on_refinement` (may be empty) hears of refinements that came with a frame, on the writer thread.
  FrameIntake(MapWriter writer, const FeedOptions& options, OnRefinement on_refinement);

  /// See FeedSeats::Take; INVALID_ARGUMENT for a bad name of a session, and what the queue refuses work with.
  Result<std::shared_ptr<Feed>> BeginFeed(FeedRequest request);
  [[nodiscard]] FeedSeats& seats() { return seats_; }
  [[nodiscard]] const FeedSeats& seats() const { return seats_; }
  /// See ListSessions.
  [[nodiscard]] std::vector<SessionStatus> Sessions() const;

  /// See MapSession::Integrate. `feed` may be null: one who feeds alone, without a name.
  void Integrate(const std::shared_ptr<Feed>& feed, ArrivedFrame arrived, std::function<void(FrameOutcome)> done);
  /// Tells how far the feed has got, in turn with its frames.
  void Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done);
  /// The same at once.
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
