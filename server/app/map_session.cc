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
      store_(store),
      numbers_(store, {snapshot->revision(), snapshot->info().next_submap_id}),
      commits_(store, snapshot, options_.commit_retry_s, ObserverOf(options_)),
      seat_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.feed_idle_s))),
      builder_(snapshot, PoolOf(options_), RefinementTiming::kNeverWait, options_.refinement_slots),
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
  return seat_.Take(std::move(request));
}

void MapSession::Integrate(Result<PanopticFrame> frame, std::function<void(FrameOutcome)> done) {
  Integrate(nullptr, 0, std::move(frame), std::move(done));
}

void MapSession::Integrate(const std::shared_ptr<Feed>& feed, std::int64_t sequence, Result<PanopticFrame> frame,
                           std::function<void(FrameOutcome)> done) {
  if (feed) feed->OnFrameBegun();
  const auto answer = [this, feed, done = std::move(done)](FrameOutcome outcome) {
    if (feed) feed->OnFrameDone(seat_.Now());
    done(std::move(outcome));
  };
  auto shared = std::make_shared<Result<PanopticFrame>>(std::move(frame));
  Post({.run = [this, feed, sequence, shared, answer] { answer(IntegrateNow(feed, sequence, std::move(*shared))); },
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

void MapSession::Edit(EditRequest request, std::function<void(Result<EditOutcome>)> done) {
  auto run = [this, request = std::move(request), done] { done(EditNow(request)); };
  Post({.run = std::move(run),
        .refuse = [done = std::move(done)](const Status& status) { done(status); },
        .is_edit = true});
}

void MapSession::Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done,
                      EditMode mode) {
  auto make = [change = std::move(change)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId submap, change(map));
    return EditMade{.submap = submap, .summary = {}};
  };
  Edit(EditRequest{.change = std::move(make), .mode = mode}, std::move(done));
}

Result<EditOutcome> MapSession::EditNow(const EditRequest& request) {
  const bool is_tried = request.mode == EditMode::kTryOnly;
  if (!is_tried && !request.source.request_id.empty()) {  // before all else: an etag would be the old one
    DHPMAP_ASSIGN_OR_RETURN(auto repeated, FindRepeated(request.source));
    if (repeated) return *std::move(repeated);
  }
  // First what is fused: revisions and etags of what the change meets are then those of its present state, and what is
  // dropped if the store fails is the change alone.
  Publish();
  const auto before = builder_.map().published();
  if (const Status stored = CommitPublished(); !stored.ok()) return NotMade(stored);
  Map& map = builder_.map();
  auto outcome = Guarded<Result<EditOutcome>>([&]() -> Result<EditOutcome> {
    DHPMAP_ASSIGN_OR_RETURN(const EditMade made, request.change(map));
    if (!is_tried) return StoreEdit(request, made, before);
    const auto view = View();
    return EditOutcome{view, made.submap, request.answer ? request.answer(*view, made) : std::string()};
  });
  if (!outcome.ok() || is_tried) map = Map(before);  // it may have stopped half-way
  return outcome;
}

Result<std::optional<EditOutcome>> MapSession::FindRepeated(const EditSource& source) const {
  DHPMAP_ASSIGN_OR_RETURN(auto stored, store_.FindAnswer(builder_.map().info().name, source.request_id));
  if (!stored) return std::optional<EditOutcome>();
  if (stored->request_fingerprint != source.request_fingerprint) {
    return InvalidArgument("the request has the id of another one, which made revision " +
                           std::to_string(stored->revision))
        .WithReason("REQUEST_ID_REUSED")
        .WithMetadata("revision", std::to_string(stored->revision));
  }
  return std::optional(EditOutcome{View(), SubmapId(), std::move(stored->answer)});
}

Result<EditOutcome> MapSession::StoreEdit(const EditRequest& request, const EditMade& made,
                                          const std::shared_ptr<const MapSnapshot>& before) {
  Map& map = builder_.map();
  const std::int64_t now_ns = options_.now_ns();
  if (!request.source.request_id.empty()) (void)map.mutable_info();  // even if nothing changes, it is in the log
  const auto view = std::make_shared<const MapView>(map.Publish(now_ns));
  EditOutcome outcome{view, made.submap, request.answer ? request.answer(*view, made) : std::string()};
  std::shared_ptr<EditRecord> record;
  if (view->snapshot().revision() != before->revision()) {
    record = std::make_shared<EditRecord>();
    record->entry = {view->snapshot().revision(), now_ns, request.source, made.summary};
    if (!request.source.request_id.empty()) record->answer = outcome.answer;
    record->before = before;
  }
  if (const Status stored = commits_.CommitUnseen(view->shared_snapshot(), record); !stored.ok()) {
    return NotMade(stored);
  }
  outcome.view = Show(view);
  return outcome;
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

void MapSession::Finish(std::function<void(Result<FinishOutcome>)> done, std::stop_token stop) {
  auto run = [this, done, stop = std::move(stop)] {
    const auto refinement = Guarded<Result<RefinementReport>>([&] { return FinishNow(stop); });
    if (!refinement.ok()) return done(refinement.status());
    if (options_.on_refinement) options_.on_refinement(*refinement);
    FinishOutcome outcome{.view = Publish(), .refinement = *refinement};
    RequestCommit(Durability::kFull, [done, outcome = std::move(outcome)](const Status& status) {
      if (status.ok()) done(outcome);
      else done(NotStoredYet(status));
    });
  };
  Post({.run = std::move(run),
        .refuse = [done = std::move(done)](const Status& status) { done(status); },
        .is_edit = true});
}

Status MapSession::DeleteFromStore() {
  {
    const MutexLock lock(mutex_);
    if (!refusal_.ok()) return refusal_;
  }
  DHPMAP_RETURN_IF_ERROR(seat_.Close());  // nobody may start feeding meanwhile
  std::promise<Status> outcome;
  commits_.DeleteMap([&outcome](const Status& status) { outcome.set_value(status); });
  Status status = outcome.get_future().get();
  if (!status.ok()) {
    seat_.Reopen();
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

FrameOutcome MapSession::IntegrateNow(const std::shared_ptr<Feed>& feed, std::int64_t sequence,
                                      Result<PanopticFrame> frame) {
  FrameOutcome outcome{.report = FrameReport{}};
  Status refusal = feed ? feed->MayFeed() : Status::Ok();
  if (end_.stop_requested()) refusal = ShuttingDown();
  if (!refusal.ok()) {
    outcome.report = refusal;
  } else if (feed && sequence <= builder_.map().info().sessions.LastOf(feed->session())) {
    outcome.is_duplicate = true;
  } else if (Status behind = WhyBehind(); !behind.ok()) {
    outcome.report = std::move(behind);
  } else {
    outcome.report = frame.ok() ? Fuse(feed.get(), sequence, *frame) : frame.status();
  }
  outcome.is_committed =
      num_unpublished_ == 0 && commits_.committed_revision() == builder_.map().published()->revision();
  if (feed) outcome.committed_sequence = ProgressOf(feed).committed_sequence;
  outcome.revision = View()->snapshot().revision();
  outcome.commit_status = commits_.last_outcome();
  return outcome;
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
  return View()->shared_snapshot() == snapshot ? View() : Show(std::make_shared<const MapView>(std::move(snapshot)));
}

void MapSession::ReleaseNumbers() {
  const MapInfo& info = builder_.map().info();
  if (!commits_.last_outcome().ok() || commits_.committed_revision() != info.revision) return;
  numbers_.Release(info);
}

std::shared_ptr<const MapView> MapSession::Show(std::shared_ptr<const MapView> next) {
  const auto view = View();
  if (view->shared_snapshot() == next->shared_snapshot()) return view;
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
