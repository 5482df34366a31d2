// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/frame_intake.h"

#include <chrono>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/map/session_marks.h"

namespace dhpmap {

FrameIntake::FrameIntake(MapWriter writer, const FeedOptions& options, OnRefinement on_refinement)
    : writer_(std::move(writer)),
      on_refinement_(std::move(on_refinement)),
      seats_(std::chrono::duration_cast<FeedSeats::Clock::duration>(std::chrono::duration<double>(options.idle_s)),
             options.max_feeds) {}

Result<std::shared_ptr<Feed>> FrameIntake::BeginFeed(FeedRequest request) {
  if (!request.session.empty()) DHPMAP_RETURN_IF_ERROR(ValidateSessionName(request.session));
  DHPMAP_RETURN_IF_ERROR(writer_.queue.refusal());
  return seats_.Take(std::move(request));
}

std::vector<SessionStatus> FrameIntake::Sessions() const {
  const auto view = writer_.publisher.Visible();
  return ListSessions(
      seats_, view->snapshot().info().sessions,
      [this](const std::string& session, Feed* feed) {
        if (!session.empty()) return writer_.committer.StoredSequence(session);
        return feed != nullptr ? feed->StoredUpTo(writer_.committer.stored_frames()) : std::nullopt;
      },
      writer_.now_ns());
}

/// A frame in the queue.
struct FrameIntake::Arrival {
  std::shared_ptr<Feed> feed;
  ArrivedFrame frame;
  std::int64_t arrived_ns = 0;
  FrameCheck check = {};
};

void FrameIntake::Integrate(const std::shared_ptr<Feed>& feed, ArrivedFrame arrived,
                            std::function<void(FrameOutcome)> done) {
  const std::int64_t now_ns = writer_.now_ns();
  if (feed) feed->OnFrameBegun();
  if (feed) feed->tally().OnMessage(arrived.num_bytes, now_ns);
  const auto answer = [this, feed, done = std::move(done)](FrameOutcome outcome) {
    if (feed) feed->OnFrameDone(seats_.Now());
    if (feed && !outcome.report.ok()) feed->tally().OnRefused();
    if (feed && outcome.is_duplicate) feed->tally().OnDuplicate();
    done(std::move(outcome));
  };
  const auto refusal = [this](Status status) {
    return FrameOutcome{.report = std::move(status),
                        .revision = writer_.publisher.Visible()->snapshot().revision(),
                        .commit_status = writer_.committer.last_outcome()};
  };
  try {
    auto arrival = std::make_shared<Arrival>(Arrival{feed, std::move(arrived), now_ns});
    writer_.queue.Post({.run =
                            [this, arrival, answer] {
                              auto outcome = IntegrateNow(*arrival);
                              arrival->frame = {.frame = PanopticFrame()};  // the job may be kept for a while
                              answer(std::move(outcome));
                            },
                        .refuse = [answer, refusal](const Status& status) { answer(refusal(CopyOf(status))); }});
  } catch (...) {
    answer(refusal(StatusOfException()));  // the client counts frames by their answers
  }
}

void FrameIntake::Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done) {
  const auto answer = [this, feed, done = std::move(done)] { done(ProgressOf(feed)); };
  try {
    writer_.queue.Post({.run = answer, .refuse = [answer](const Status&) { answer(); }});
  } catch (...) {
    answer();  // out of order, but correct
  }
}

FeedProgress FrameIntake::ProgressOf(const std::shared_ptr<Feed>& feed) const {
  const Committer& committer = writer_.committer;
  return {.revision = writer_.publisher.Visible()->snapshot().revision(),
          .committed_sequence = feed->session().empty() ? feed->StoredUpTo(committer.stored_frames())
                                                        : committer.StoredSequence(feed->session()),
          .commit_status = committer.last_outcome()};
}

FrameOutcome FrameIntake::IntegrateNow(Arrival& arrival) {
  FrameOutcome outcome{.report = FrameReport{}};
  outcome.report = Guarded<Result<FrameReport>>([&] { return TakeInTurn(arrival, outcome.is_duplicate); });
  outcome.check = std::move(arrival.check);
  outcome.is_committed =
      !writer_.publisher.has_changes() && writer_.committer.stored_revision() == writer_.map().published()->revision();
  if (arrival.feed) outcome.committed_sequence = ProgressOf(arrival.feed).committed_sequence;
  outcome.revision = writer_.publisher.Visible()->snapshot().revision();
  outcome.commit_status = writer_.committer.last_outcome();
  return outcome;
}

/// On a failure or exception the map is unchanged.
Result<FrameReport> FrameIntake::TakeInTurn(Arrival& arrival, bool& is_duplicate) {
  const std::shared_ptr<Feed>& feed = arrival.feed;
  if (writer_.give_up.stop_requested()) return writer_.queue.EndReason();
  if (feed) DHPMAP_RETURN_IF_ERROR(feed->MayFeed());
  if (feed && arrival.frame.sequence <= writer_.map().info().sessions.LastOf(feed->session())) {
    is_duplicate = true;
    return FrameReport{};
  }
  DHPMAP_RETURN_IF_ERROR(writer_.committer.CheckIsNotBehind());
  return TakeFrame(arrival);
}

/// Fuses the frame and records it.
Result<FrameReport> FrameIntake::TakeFrame(Arrival& arrival) {
  ArrivedFrame& arrived = arrival.frame;
  MapRecording& recording = writer_.recording;
  // A recording begins with a valid frame, else invalid streams would create files.
  if (arrived.frame.ok()) recording.Begin(writer_.map().info());
  const bool is_recorded = !arrived.message.empty() && recording.is_recorded();
  const std::string session = arrival.feed ? arrival.feed->session() : "";
  if (arrived.frame.ok()) arrived.frame->session = session;
  if (is_recorded) {
    recording.Note([&, num_frames = writer_.map().info().num_frames](FrameRecorder& recorder) {
      recorder.OnFrame(session, arrived.sequence, {std::move(arrived.message), arrival.arrived_ns}, num_frames);
    });
  }
  auto report = Guarded<Result<FrameReport>>([&]() -> Result<FrameReport> {
    if (!arrived.frame.ok()) return arrived.frame.status();
    // Each stream without a session has its own clock.
    if (arrival.feed && session.empty() && arrival.feed->BeginsNow()) writer_.builder.ForgetStamp(session);
    return Fuse(arrival.feed.get(), arrived.sequence, *arrived.frame);
  });
  if (arrived.frame.ok()) arrival.check = writer_.builder.TakeCheck();
  // A frame that is refused for another reason says nothing on its plausibility.
  if (arrival.feed && (report.ok() || !arrival.check.IsPlausible()))
    arrival.feed->tally().OnChecked(arrival.check.warnings);
  if (!is_recorded) return report;
  if (!report.ok()) recording.Note([&](FrameRecorder& recorder) { recorder.OnRefused(report.status()); });
  else if (report->refinement) recording.Note([](FrameRecorder& recorder) { recorder.OnRefined(); });
  return report;
}

/// On a failure or exception the map is unchanged.
Result<FrameReport> FrameIntake::Fuse(Feed* feed, std::int64_t sequence, const PanopticFrame& frame) {
  const std::int64_t now_ns = writer_.now_ns();
  const bool has_session = feed != nullptr && !feed->session().empty();
  SessionMarks sessions;
  if (has_session) {
    sessions = writer_.map().info().sessions;
    sessions.Set({feed->session(), sequence, now_ns});
  }
  auto report =
      writer_.builder.Integrate(frame, writer_.give_up, feed ? feed->implausible() : ImplausibleFrames::kFuse);
  if (report.status().code() == StatusCode::kCancelled) return writer_.queue.EndReason();
  if (!report.ok()) return report;
  // The frame is in the map: nothing may throw from here on.
  if (has_session) writer_.map().mutable_info().sessions = std::move(sessions);
  OnFused(feed, sequence, now_ns, frame, *report);
  return report;
}

void FrameIntake::OnFused(Feed* feed, std::int64_t sequence, std::int64_t now_ns, const PanopticFrame& frame,
                          const FrameReport& report) {
  const std::int64_t num_frames = writer_.map().info().num_frames;
  writer_.committer.OnFused(num_frames);
  if (feed) feed->OnFused(num_frames, sequence);
  if (feed) feed->tally().OnFused(sequence, report.num_points, now_ns, frame.T_map_sensor);
  if (report.refinement && on_refinement_) TellSafely([&] { on_refinement_(*report.refinement); });
  writer_.batches.NoteChange();
  writer_.batches.DoThoseDue();
}

}  // namespace dhpmap
