// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_session.h"

#include <algorithm>
#include <exception>
#include <future>
#include <string>
#include <utility>

#include "mapping/base/this_thread.h"
#include "mapping/map/session_marks.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

Clock::time_point In(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

std::int64_t SystemNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

SessionOptions WithClock(SessionOptions options) {
  if (!options.now_ns) options.now_ns = SystemNow;
  return options;
}

/// What is answered when a finished map could not be made durable.
Status NotStoredYet(const Status& cause) {
  return Status(cause.code(), "the map is finished, but is not in the store yet: " + cause.message())
      .WithReason(cause.reason().empty() ? Reason("NOT_STORED") : cause.reason());
}

/// What an edit is answered that did not happen because it could not be stored.
Status NotMade(const Status& cause) {
  return Status(cause.code(), "nothing was changed, because it cannot be stored: " + cause.message())
      .WithReason(cause.reason().empty() ? Reason("NOT_STORED") : cause.reason());
}

Status ShuttingDown() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

/// The writer must outlive whatever goes wrong in one job, such as an allocation that fails.
template <typename Outcome, typename Work>
Outcome Guarded(Work&& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    return Outcome(Internal(std::string("unexpected failure while writing to the map: ") + error.what()));
  }
}

/// Hears of every commit; of those that went well, others do, too.
CommitWorker::Observer ObserverOf(const SessionOptions& options) {
  return [on_commit = options.on_commit, on_stored = options.on_stored](double seconds, const Status& status) {
    if (on_commit) on_commit(seconds, status);
    if (on_stored && status.ok()) on_stored();
  };
}

std::shared_ptr<ThreadPool> PoolOf(const SessionOptions& options) {
  return options.pool ? options.pool : std::make_shared<ThreadPool>(options.num_threads);
}

}  // namespace

MapSession::MapSession(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, SessionOptions options)
    : options_(WithClock(std::move(options))),
      numbers_(store, {snapshot->revision(), snapshot->info().next_submap_id}),
      commits_(store, snapshot, options_.commit_retry_s, ObserverOf(options_)),
      seats_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.feed_idle_s)),
             options_.max_feeds),
      builder_(snapshot, PoolOf(options_), options_.refinement_timing, options_.refinement_slots),
      view_(std::make_shared<const MapView>(std::move(snapshot))) {}

MapSession::~MapSession() { (void)Stop(); }

std::shared_ptr<const MapView> MapSession::View() const {
  const MutexLock lock(view_mutex_);
  return view_;
}

Result<std::shared_ptr<Feed>> MapSession::BeginFeed(FeedRequest request) {
  if (!request.session.empty()) DHPMAP_RETURN_IF_ERROR(ValidateSessionName(request.session));
  {
    const MutexLock lock(mutex_);
    if (!refusal_.ok()) return refusal_;
  }
  return seats_.Take(std::move(request));
}

std::vector<SessionStatus> MapSession::Sessions() const {
  const auto view = View();
  return ListSessions(
      seats_, view->snapshot().info().sessions,
      [this](const std::string& session, Feed* feed) {
        if (!session.empty()) return commits_.committed_sequence(session);
        return feed != nullptr ? feed->StoredUpTo(commits_.committed_frames()) : std::nullopt;
      },
      options_.now_ns());
}

/// A frame on its way through the queue.
struct MapSession::Arrival {
  std::shared_ptr<Feed> feed;
  ArrivedFrame frame;
  std::int64_t arrived_ns = 0;
};

void MapSession::Integrate(Result<PanopticFrame> frame, std::function<void(FrameOutcome)> done) {
  Integrate(nullptr, 0, std::move(frame), std::move(done));
}

void MapSession::Integrate(const std::shared_ptr<Feed>& feed, ArrivedFrame arrived,
                           std::function<void(FrameOutcome)> done) {
  const std::int64_t now_ns = options_.now_ns();
  if (feed) feed->OnFrameBegun();
  if (feed) feed->tally().OnMessage(arrived.num_bytes, now_ns);
  const auto answer = [this, feed, done = std::move(done)](FrameOutcome outcome) {
    if (feed) feed->OnFrameDone(seats_.Now());
    if (feed && !outcome.report.ok()) feed->tally().OnRefused();
    if (feed && outcome.is_duplicate) feed->tally().OnDuplicate();
    done(std::move(outcome));
  };
  auto arrival = std::make_shared<Arrival>(Arrival{feed, std::move(arrived), now_ns});
  Post({.run =
            [this, arrival, answer] {
              auto outcome = IntegrateNow(*arrival);
              arrival->frame = {.frame = PanopticFrame()};  // the job may be kept for a while
              answer(std::move(outcome));
            },
        .refuse =
            [this, answer](const Status& status) {
              answer({.report = status,
                      .revision = View()->snapshot().revision(),
                      .commit_status = commits_.last_outcome()});
            }});
}

void MapSession::Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done) {
  const auto answer = [this, feed, done = std::move(done)] { done(ProgressOf(feed)); };
  Post({.run = answer, .refuse = [answer](const Status&) { answer(); }});
}

FeedProgress MapSession::ProgressOf(const std::shared_ptr<Feed>& feed) const {
  return {.revision = View()->snapshot().revision(),
          .committed_sequence = feed->session().empty() ? feed->StoredUpTo(commits_.committed_frames())
                                                        : commits_.committed_sequence(feed->session()),
          .commit_status = commits_.last_outcome()};
}

void MapSession::Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done,
                      EditMode mode) {
  auto run = [this, change = std::move(change), done, mode] { done(EditNow(change, mode)); };
  Post({.run = std::move(run),
        .refuse = [done = std::move(done)](const Status& status) { done(status); },
        .is_edit = true});
}

Result<EditOutcome> MapSession::EditNow(const std::function<Result<SubmapId>(Map&)>& change, EditMode mode) {
  // First what is fused: revisions and etags of what the change meets are then those of its present state, and what is
  // dropped if the store fails is the change alone.
  Publish();
  const auto before = builder_.map().published();
  if (const Status stored = CommitPublished(); !stored.ok()) return NotMade(stored);
  Map& map = builder_.map();
  auto submap = Guarded<Result<SubmapId>>([&] { return change(map); });
  if (!submap.ok()) {
    map = Map(before);  // it may have stopped half-way
    return submap.status();
  }
  if (mode == EditMode::kTryOnly) {
    map = Map(before);
    return EditOutcome{.view = View(), .submap = *submap};
  }
  auto after = map.Publish(options_.now_ns());
  if (const Status stored = commits_.CommitUnseen(after); !stored.ok()) {
    map = Map(before);
    return NotMade(stored);
  }
  if (recorder_ && *recorder_) (*recorder_)->OnEdited(after->revision());
  return EditOutcome{.view = Show(std::move(after)), .submap = *submap};
}

void MapSession::Flush(std::function<void(const Status&)> done) {
  auto run = [this, done] {
    Publish();
    RequestCommit(Durability::kFull, done);
  };
  Post({.run = std::move(run), .refuse = std::move(done)});
}

Result<RefinementReport> MapSession::FinishNow(const std::stop_token& stop) {
  const auto is_cancelled = [this, &stop] { return stop.stop_requested() || end_.stop_requested(); };
  const auto report = builder_.Finish(is_cancelled);
  if (report) return *report;
  if (end_.stop_requested()) return ShuttingDown();
  return Cancelled("nobody waits for the end of mapping any longer: the map is as it was");
}

struct MapSession::FinishCall {
  TimePoint begin = Clock::now();
  FinishStage stage = FinishStage::kWaiting;  ///< guarded by mutex_
};

void MapSession::SetStage(const std::shared_ptr<FinishCall>& call, FinishStage stage) {
  {
    const MutexLock lock(mutex_);
    call->stage = stage;
  }
  if (options_.on_finishing) options_.on_finishing();
}

void MapSession::EndFinish(const std::shared_ptr<FinishCall>& call) {
  {
    const MutexLock lock(mutex_);
    std::erase(finish_calls_, call);
  }
  if (options_.on_finishing) options_.on_finishing();
}

std::optional<FinishProgress> MapSession::Finishing() const {
  const MutexLock lock(mutex_);
  if (finish_calls_.empty()) return std::nullopt;
  const FinishCall& first = *finish_calls_.front();
  return FinishProgress{first.stage, std::chrono::duration<double>(Clock::now() - first.begin).count()};
}

void MapSession::Finish(std::function<void(Result<FinishOutcome>)> on_done, std::stop_token stop) {
  const auto call = std::make_shared<FinishCall>();
  {
    const MutexLock lock(mutex_);
    finish_calls_.push_back(call);
  }
  if (options_.on_finishing) options_.on_finishing();
  const auto done = [this, call, on_done = std::move(on_done)](const Result<FinishOutcome>& outcome) {
    EndFinish(call);  // before the caller knows
    on_done(outcome);
  };
  auto run = [this, call, done, stop = std::move(stop)] {
    SetStage(call, FinishStage::kRefining);
    const auto refinement = Guarded<Result<RefinementReport>>([&] { return FinishNow(stop); });
    if (!refinement.ok()) return done(refinement.status());
    SetStage(call, FinishStage::kStoring);
    if (options_.on_refinement) options_.on_refinement(*refinement);
    if (recorder_ && *recorder_) (*recorder_)->OnFinished();
    FinishOutcome outcome{.view = Publish(), .refinement = *refinement};
    RequestCommit(Durability::kFull, [done, outcome = std::move(outcome)](const Status& status) {
      if (status.ok()) done(outcome);
      else done(NotStoredYet(status));
    });
  };
  Post({.run = std::move(run), .refuse = [done](const Status& status) { done(status); }, .is_edit = true});
}

Status MapSession::DeleteFromStore() {
  {
    const MutexLock lock(mutex_);
    if (!refusal_.ok()) return refusal_;
  }
  DHPMAP_RETURN_IF_ERROR(seats_.Close());  // nobody may start feeding meanwhile
  std::promise<Status> outcome;
  commits_.DeleteMap([&outcome](const Status& status) { outcome.set_value(status); });
  Status status = outcome.get_future().get();
  if (!status.ok()) {
    seats_.Reopen();
    return status;
  }
  const MutexLock lock(mutex_);
  refusal_ = NotFound("the map has been deleted").WithReason("MAP_NOT_FOUND");
  return status;
}

bool MapSession::IsAtRest() const {
  {
    const MutexLock lock(mutex_);
    if (!jobs_.empty() || is_running_) return false;
  }
  return BehindSeconds() == 0 && commits_.committed_revision() == View()->snapshot().revision();
}

Status MapSession::Stop() {
  const MutexLock stop_lock(stop_mutex_);  // of two callers the second waits for the end, too
  bool is_deleted = false;
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
    end_.request_stop();
    is_deleted = refusal_.code() == StatusCode::kNotFound;  // its name may be another map's by now
    if (refusal_.ok()) refusal_ = ShuttingDown();
    // One that has retired comes back for what it does at the end; without a thread there is nothing new to store.
    if (writer_.has_run()) (void)writer_.Start([this] { WriterLoop(); });
  }
  wake_.NotifyOne();
  writer_.Join();
  commits_.Stop();
  if (!is_deleted) ReleaseNumbers();
  return commits_.last_outcome();
}

void MapSession::Post(Job job) {
  Status refused;
  {
    const MutexLock lock(mutex_);
    refused = refusal_;
    if (refused.ok() && job.is_edit && num_pending_edits_ >= options_.max_pending_edits) {
      refused = ResourceExhausted("too many edits wait for this map").WithReason("TOO_MANY_EDITS");
    }
    if (refused.ok()) refused = writer_.Start([this] { WriterLoop(); });
    if (refused.ok()) {
      num_pending_edits_ += job.is_edit ? 1 : 0;
      jobs_.push_back(std::move(job));
      wake_.NotifyOne();
      return;
    }
  }
  job.refuse(refused);
}

void MapSession::WriterLoop() {
  NameThisThread("map-writer");
  (void)TakeTurns(Turns::kOrdinary);  // a quick thread has begun it
  MutexLock lock(mutex_);
  while (!stopping_) {
    const auto is_ready = [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !jobs_.empty(); };
    if (num_unpublished_ > 0) {
      wake_.WaitUntil(mutex_, std::min(publish_due_, commit_due_), is_ready);
    } else if (num_uncommitted_ > 0) {
      wake_.WaitUntil(mutex_, commit_due_, is_ready);
    } else if (!wake_.WaitFor(mutex_, LazyThread::kIdle, is_ready)) {
      return writer_.Retire();
    }
    if (!stopping_ && !jobs_.empty()) RunOne();
    lock.Unlock();
    DoBatchesThatAreDue();
    lock.Lock();
  }
  const std::deque<Job> refused = std::exchange(jobs_, {});
  const Status status = refusal_;
  lock.Unlock();
  for (const Job& job : refused) job.refuse(status);
  Publish();
  RequestCommit(Durability::kFull);
}

void MapSession::RunOne() {
  {
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    num_pending_edits_ -= job.is_edit ? 1 : 0;
    is_running_ = true;
    mutex_.Unlock();
    job.run();
  }
  mutex_.Lock();
  is_running_ = false;
}

void MapSession::DoBatchesThatAreDue() {
  const auto now = Clock::now();
  if (num_uncommitted_ > 0 && (num_uncommitted_ >= options_.commit_frames || now >= commit_due_)) {
    Publish();
    // On the commit thread: here fusion would wait for the store, which may be in the middle of a commit.
    RequestCommit(Durability::kNormal, [this, name = builder_.map().info().name](const Status& status) {
      if (status.ok()) numbers_.GoAhead(name);
    });
  } else if (num_unpublished_ > 0 && (num_unpublished_ >= options_.publish_frames || now >= publish_due_)) {
    Publish();
  }
}

double MapSession::BehindSeconds() const {
  lag_.OnStored(commits_.committed_frames());
  return lag_.Seconds(StoreLag::Clock::now());
}

/// More frames would only be more that a crash can take.
Status MapSession::WhyBehind() const {
  const double behind_s = BehindSeconds();
  if (behind_s <= options_.max_behind_s) return Status::Ok();
  const std::string cause = commits_.last_outcome().message();
  return Unavailable("the store is " + std::to_string(static_cast<int>(behind_s)) + " s behind" +
                     (cause.empty() ? "" : ": " + cause) + "; send the frame again when it has caught up")
      .WithReason("STORE_BEHIND");
}

FrameOutcome MapSession::IntegrateNow(Arrival& arrival) {
  const std::shared_ptr<Feed>& feed = arrival.feed;
  FrameOutcome outcome{.report = FrameReport{}};
  Status refusal = feed ? feed->MayFeed() : Status::Ok();
  if (end_.stop_requested()) refusal = ShuttingDown();
  if (!refusal.ok()) {
    outcome.report = refusal;
  } else if (feed && arrival.frame.sequence <= builder_.map().info().sessions.LastOf(feed->session())) {
    outcome.is_duplicate = true;
  } else if (Status behind = WhyBehind(); !behind.ok()) {
    outcome.report = std::move(behind);
  } else {
    outcome.report = TakeFrame(arrival);
  }
  outcome.is_committed =
      num_unpublished_ == 0 && commits_.committed_revision() == builder_.map().published()->revision();
  if (feed) outcome.committed_sequence = ProgressOf(feed).committed_sequence;
  outcome.revision = View()->snapshot().revision();
  outcome.commit_status = commits_.last_outcome();
  return outcome;
}

/// Fuses the frame, and has it recorded.
Result<FrameReport> MapSession::TakeFrame(Arrival& arrival) {
  auto& [sequence, frame, num_bytes, message] = arrival.frame;
  if (!recorder_) recorder_ = options_.make_recorder ? options_.make_recorder(builder_.map().info()) : nullptr;
  FrameRecorder* const recorder = message.empty() ? nullptr : recorder_->get();
  const std::string session = arrival.feed ? arrival.feed->session() : "";
  if (recorder != nullptr) {
    recorder->OnFrame(session, sequence, {std::move(message), arrival.arrived_ns}, builder_.map().info().num_frames);
  }
  if (frame.ok()) frame->session = session;
  auto report = frame.ok() ? Fuse(arrival.feed.get(), sequence, *frame) : frame.status();
  if (recorder != nullptr && !report.ok()) recorder->OnRefused(report.status());
  if (recorder != nullptr && report.ok() && report->refinement) recorder->OnRefined();
  return report;
}

Result<FrameReport> MapSession::Fuse(Feed* feed, std::int64_t sequence, const PanopticFrame& frame) {
  auto report = Guarded<Result<FrameReport>>([&] { return builder_.Integrate(frame, end_.get_token()); });
  if (report.status().code() == StatusCode::kCancelled) return ShuttingDown();
  if (!report.ok()) return report;
  lag_.OnFused(builder_.map().info().num_frames, StoreLag::Clock::now());
  if (feed) {
    MapInfo& info = builder_.map().mutable_info();
    if (!feed->session().empty()) info.sessions.Set({feed->session(), sequence, options_.now_ns()});
    feed->OnFused(info.num_frames, sequence);
    feed->tally().OnFused(sequence, report->num_points, options_.now_ns());
  }
  if (report->refinement && options_.on_refinement) options_.on_refinement(*report->refinement);
  if (num_unpublished_++ == 0) publish_due_ = In(options_.publish_s);
  if (num_uncommitted_++ == 0) commit_due_ = In(options_.commit_s);
  DoBatchesThatAreDue();
  return report;
}

std::shared_ptr<const MapView> MapSession::Publish() {
  num_unpublished_ = 0;
  auto snapshot = builder_.map().Publish(options_.now_ns());
  // Nobody sees numbers that might be given out again after a crash; the next turn tries again.
  if (!numbers_.Cover(snapshot->info()).ok() && commits_.committed_revision() != snapshot->revision()) return View();
  return Show(std::move(snapshot));
}

void MapSession::ReleaseNumbers() {
  const MapInfo& info = builder_.map().info();
  if (!commits_.last_outcome().ok() || commits_.committed_revision() != info.revision) return;
  numbers_.Release(info);
}

std::shared_ptr<const MapView> MapSession::Show(std::shared_ptr<const MapSnapshot> snapshot) {
  auto view = View();
  if (view->shared_snapshot() == snapshot) return view;
  auto next = std::make_shared<const MapView>(std::move(snapshot));
  {
    const MutexLock lock(view_mutex_);
    view_ = next;  // `view` still holds the old one: nothing is freed under the lock
  }
  if (options_.on_publish) options_.on_publish(next->shared_snapshot());
  return next;
}

/// Not with a full sync: that comes with the commit of the change.
Status MapSession::CommitPublished() {
  if (commits_.committed_revision() == builder_.map().published()->revision()) return Status::Ok();
  std::promise<Status> outcome;
  RequestCommit(Durability::kNormal, [&outcome](const Status& status) { outcome.set_value(status); });
  return outcome.get_future().get();
}

void MapSession::RequestCommit(Durability durability, CommitWorker::Done done) {
  num_uncommitted_ = 0;
  commits_.Request(builder_.map().published(), durability, std::move(done));
}

}  // namespace dhpmap
