// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_session.h"

#include <algorithm>
#include <functional>
#include <future>
#include <string>
#include <utility>

#include "mapping/base/guarded.h"
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

/// Hears of every commit; of those that went well, others do, too.
CommitWorker::Observer ObserverOf(const SessionOptions& options) {
  return [on_commit = options.on_commit, on_stored = options.on_stored](double seconds, const Status& status) {
    if (on_commit) TellSafely([&] { on_commit(seconds, status); });
    if (on_stored && status.ok()) TellSafely(on_stored);
  };
}

/// Of a map that begins with what the store has.
std::shared_ptr<KeptStates> KeptFrom(const std::shared_ptr<const MapSnapshot>& stored, const SessionOptions& options) {
  auto budget = options.kept_budget ? options.kept_budget : std::make_shared<ByteBudget>(options.kept_states_bytes);
  auto kept = std::make_shared<KeptStates>(options.max_kept_states, std::move(budget));
  kept->Keep(stored);
  return kept;
}

std::shared_ptr<ThreadPool> PoolOf(const SessionOptions& options) {
  return options.pool ? options.pool : std::make_shared<ThreadPool>(options.num_threads);
}

}  // namespace

MapSession::MapSession(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, SessionOptions options)
    : options_(WithClock(std::move(options))),
      store_(store),
      numbers_(store, {snapshot->revision(), snapshot->info().next_submap_id}),
      kept_states_(KeptFrom(snapshot, options_)),
      commits_(store, snapshot, options_.commit_retry_s, ObserverOf(options_),
               [this](const std::shared_ptr<const MapSnapshot>& state) { OnStored(state); }),
      seats_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.feed_idle_s)),
             options_.max_feeds),
      builder_(snapshot, PoolOf(options_), options_.refinement_timing, options_.refinement_slots),
      shown_(std::make_shared<ShownView>(std::make_shared<const MapView>(std::move(snapshot)), options_.prepare)) {}

MapSession::~MapSession() { (void)Stop(); }

Status MapSession::ShuttingDown() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

std::shared_ptr<const MapView> MapSession::View() const { return shown_->Get(); }

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
  FrameCheck check = {};
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
  const auto refusal = [this](Status status) {
    return FrameOutcome{.report = std::move(status),
                        .revision = View()->snapshot().revision(),
                        .commit_status = commits_.last_outcome()};
  };
  try {
    auto arrival = std::make_shared<Arrival>(Arrival{feed, std::move(arrived), now_ns});
    Post({.run =
              [this, arrival, answer] {
                auto outcome = IntegrateNow(*arrival);
                arrival->frame = {.frame = PanopticFrame()};  // the job may be kept for a while
                answer(std::move(outcome));
              },
          .refuse = [answer, refusal](const Status& status) { answer(refusal(CopyOf(status))); }});
  } catch (...) {
    answer(refusal(StatusOfException()));  // the feeder counts its frames by the answers
  }
}

void MapSession::Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done) {
  const auto answer = [this, feed, done = std::move(done)] { done(ProgressOf(feed)); };
  try {
    Post({.run = answer, .refuse = [answer](const Status&) { answer(); }});
  } catch (...) {
    answer();  // out of turn, but true
  }
}

FeedProgress MapSession::ProgressOf(const std::shared_ptr<Feed>& feed) const {
  return {.revision = View()->snapshot().revision(),
          .committed_sequence = feed->session().empty() ? feed->StoredUpTo(commits_.committed_frames())
                                                        : commits_.committed_sequence(feed->session()),
          .commit_status = commits_.last_outcome()};
}

void MapSession::Flush(std::function<void(const Status&)> done) {
  auto run = [this, done] {
    const Status failed = Guarded<Status>([&] {
      Publish();
      RequestCommit(Durability::kFull, done);
      return Status::Ok();
    });
    if (!failed.ok()) done(failed);
  };
  Post({.run = std::move(run), .refuse = std::move(done)});
}

Status MapSession::DeleteFromStore() {
  {
    const MutexLock lock(mutex_);
    if (!refusal_.ok()) return refusal_;
  }
  Status refusal =
      NotFound("the map has been deleted").WithReason("MAP_NOT_FOUND");  // now: afterwards nothing may fail
  DHPMAP_RETURN_IF_ERROR(seats_.Close());                                // nobody may start feeding meanwhile
  Status status = Guarded<Status>([this] {
    std::promise<Status> outcome;
    commits_.DeleteMap([&outcome](const Status& stored) { outcome.set_value(CopyOf(stored)); });
    return outcome.get_future().get();
  });
  if (!status.ok()) {
    seats_.Reopen();
    return status;
  }
  const MutexLock lock(mutex_);
  refusal_ = std::move(refusal);
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
    if (refusal_.ok()) refusal_ = Guarded<Status>(ShuttingDown);
    // One that has retired comes back for what it does at the end; without a thread there is nothing new to store.
    if (writer_.has_run()) (void)Guarded<Status>([this] { return writer_.Start([this] { WriterLoop(); }); });
  }
  wake_.NotifyOne();
  writer_.Join();
  commits_.Stop();
  if (!is_deleted) TellSafely([this] { ReleaseNumbers(); });  // a gap is no harm
  const MutexLock lock(mutex_);
  return end_outcome_.ok() ? commits_.last_outcome() : CopyOf(end_outcome_);
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
      jobs_.push_back(std::move(job));
      num_pending_edits_ += jobs_.back().is_edit ? 1 : 0;
      wake_.NotifyOne();
      return;
    }
  }
  TellSafely([&] { job.refuse(refused); });
}

void MapSession::WriterLoop() {
  NameThisThread("map-writer");
  (void)TakeTurns(Turns::kOrdinary);  // a quick thread has begun it
  MutexLock lock(mutex_);
  while (!stopping_) {
    const auto is_ready = [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !jobs_.empty(); };
    if (const auto due = BatchDue()) wake_.WaitUntil(mutex_, *due, is_ready);
    else if (!wake_.WaitFor(mutex_, LazyThread::kIdle, is_ready)) return writer_.Retire();
    if (!stopping_ && !jobs_.empty()) RunOne();
    lock.Unlock();
    DoBatchesThatAreDue();
    LetGoOfPages();
    lock.Lock();
  }
  lock.Unlock();
  RefuseAll();
  StoreTheRest();
}

MapSession::Job MapSession::TakeJob() {
  Job job = std::move(jobs_.front());
  jobs_.pop_front();
  num_pending_edits_ -= job.is_edit ? 1 : 0;
  return job;
}

void MapSession::RunOne() {
  {
    const Job job = TakeJob();
    is_running_ = true;
    mutex_.Unlock();
    TellSafely(job.run);
  }
  mutex_.Lock();
  is_running_ = false;
}

/// When no more jobs are taken.
void MapSession::RefuseAll() {
  MutexLock lock(mutex_);
  const Status status = CopyOf(refusal_);
  while (!jobs_.empty()) {
    {
      const Job job = TakeJob();
      lock.Unlock();
      TellSafely([&] { job.refuse(status); });
    }  // gone before the lock: what it holds of Finish waits for a callback that wants it
    lock.Lock();
  }
}

/// What fails for want of memory is tried once more: jobs have given some back.
void MapSession::StoreTheRest() {
  const auto store = [this] {
    Publish();
    RequestCommit(Durability::kFull);
    return Status::Ok();
  };
  Status outcome = Guarded<Status>(store);
  if (!outcome.ok()) outcome = Guarded<Status>(store);
  const MutexLock lock(mutex_);
  if (end_outcome_.ok()) end_outcome_ = std::move(outcome);
}

/// A change that is to be seen and stored with others, or alone after a while.
void MapSession::NoteChange() {
  if (num_unpublished_++ == 0) publish_due_ = In(options_.publish_s);
  if (num_uncommitted_++ == 0) commit_due_ = In(options_.commit_s);
}

/// When there is something to publish, show or commit; none: there is nothing.
std::optional<MapSession::TimePoint> MapSession::BatchDue() const {
  const bool is_waiting = shown_->IsWaiting();
  std::optional<TimePoint> due;
  const auto by = [&due](TimePoint time) { due = due ? std::min(*due, time) : time; };
  if (num_unpublished_ > 0) by(publish_due_);
  if (is_batch_waiting_ ? !is_waiting : num_uncommitted_ > 0) by(commit_due_);
  if (is_waiting) by(show_due_);
  return due;
}

void MapSession::DoBatchesThatAreDue() {
  const Status status = Guarded<Status>([this] {
    const auto now = Clock::now();
    if (now >= show_due_) shown_->ShowNewest();
    const bool is_commit_due = num_uncommitted_ > 0 && !is_batch_waiting_ &&
                               (num_uncommitted_ >= options_.commit_frames || now >= commit_due_);
    const bool is_publish_due =
        num_unpublished_ > 0 && (num_unpublished_ >= options_.publish_frames || now >= publish_due_);
    if (is_batch_waiting_ && (is_publish_due || !shown_->IsWaiting())) CommitBatch();
    if (num_unpublished_ > 0 && (is_commit_due || is_publish_due)) PublishPrepared();
    if (is_commit_due) {
      is_batch_waiting_ = true;
      num_uncommitted_ = 0;
      if (!shown_->IsWaiting()) CommitBatch();
    }
    return Status::Ok();
  });
  if (!status.ok()) publish_due_ = commit_due_ = In(options_.commit_retry_s);  // it is still to be done
}

/// Of what was published last, which is seen first: nobody is told of a state that nobody sees. On the commit thread:
/// here fusion would wait for the store, which may be in the middle of a commit.
void MapSession::CommitBatch() {
  shown_->ShowNewest();
  commits_.Request(builder_.map().published(), Durability::kNormal,
                   [this, name = builder_.map().info().name](const Status& stored) {
                     if (stored.ok()) numbers_.GoAhead(name);
                   });
  is_batch_waiting_ = false;
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
  FrameOutcome outcome{.report = FrameReport{}};
  outcome.report = Guarded<Result<FrameReport>>([&] { return TakeInTurn(arrival, outcome.is_duplicate); });
  outcome.check = std::move(arrival.check);
  outcome.is_committed =
      num_unpublished_ == 0 && commits_.committed_revision() == builder_.map().published()->revision();
  if (arrival.feed) outcome.committed_sequence = ProgressOf(arrival.feed).committed_sequence;
  outcome.revision = View()->snapshot().revision();
  outcome.commit_status = commits_.last_outcome();
  return outcome;
}

/// If it fails or throws, the map is as it was.
Result<FrameReport> MapSession::TakeInTurn(Arrival& arrival, bool& is_duplicate) {
  const std::shared_ptr<Feed>& feed = arrival.feed;
  if (end_.stop_requested()) return ShuttingDown();
  if (feed) DHPMAP_RETURN_IF_ERROR(feed->MayFeed());
  if (feed && arrival.frame.sequence <= builder_.map().info().sessions.LastOf(feed->session())) {
    is_duplicate = true;
    return FrameReport{};
  }
  DHPMAP_RETURN_IF_ERROR(WhyBehind());
  return TakeFrame(arrival);
}

/// Fuses the frame, and has it recorded.
Result<FrameReport> MapSession::TakeFrame(Arrival& arrival) {
  ArrivedFrame& arrived = arrival.frame;
  // A record begins with a frame that can be read, or maps that nobody can map would leave files.
  if (!recorder_ && arrived.frame.ok()) {
    recorder_ = options_.make_recorder ? options_.make_recorder(builder_.map().info()) : nullptr;
  }
  FrameRecorder* const recorder = arrived.message.empty() || !recorder_ ? nullptr : recorder_->get();
  const std::string session = arrival.feed ? arrival.feed->session() : "";
  if (arrived.frame.ok()) arrived.frame->session = session;
  if (recorder != nullptr) {
    const std::int64_t num_frames = builder_.map().info().num_frames;
    TellSafely([&] {
      recorder->OnFrame(session, arrived.sequence, {std::move(arrived.message), arrival.arrived_ns}, num_frames);
    });
  }
  auto report = Guarded<Result<FrameReport>>([&]() -> Result<FrameReport> {
    if (!arrived.frame.ok()) return arrived.frame.status();
    // Streams without a session are others each time, and so are their clocks.
    if (arrival.feed && session.empty() && arrival.feed->BeginsNow()) builder_.ForgetStamp(session);
    return Fuse(arrival.feed.get(), arrived.sequence, *arrived.frame);
  });
  if (arrived.frame.ok()) arrival.check = builder_.TakeCheck();
  if (recorder != nullptr && !report.ok()) TellSafely([&] { recorder->OnRefused(report.status()); });
  if (recorder != nullptr && report.ok() && report->refinement) TellSafely([&] { recorder->OnRefined(); });
  return report;
}

/// If it fails or throws, the map is as it was.
Result<FrameReport> MapSession::Fuse(Feed* feed, std::int64_t sequence, const PanopticFrame& frame) {
  const std::int64_t now_ns = options_.now_ns();
  const bool has_session = feed != nullptr && !feed->session().empty();
  SessionMarks sessions;
  if (has_session) {
    sessions = builder_.map().info().sessions;
    sessions.Set({feed->session(), sequence, now_ns});
  }
  auto report = builder_.Integrate(frame, end_.get_token(), feed ? feed->implausible() : ImplausibleFrames::kFuse);
  if (report.status().code() == StatusCode::kCancelled) return ShuttingDown();
  if (!report.ok()) return report;
  // It is in the map: nothing may throw from here on.
  if (has_session) builder_.map().mutable_info().sessions = std::move(sessions);
  const std::int64_t num_frames = builder_.map().info().num_frames;
  lag_.OnFused(num_frames, StoreLag::Clock::now());
  if (feed) feed->OnFused(num_frames, sequence);
  if (feed) feed->tally().OnFused(sequence, report->num_points, now_ns);
  if (report->refinement && options_.on_refinement) {
    TellSafely([&] { options_.on_refinement(*report->refinement); });
  }
  NoteChange();
  DoBatchesThatAreDue();
  return report;
}

/// Of what was fused; null: nobody may see it yet. If it throws, what is to be seen still is.
std::shared_ptr<const MapView> MapSession::MakeView() {
  auto snapshot = builder_.map().Publish(options_.now_ns());
  // Nobody sees numbers that might be given out again after a crash; the next turn tries again.
  const Status covered = Guarded<Status>([&] { return numbers_.Cover(snapshot->info()); });
  if (!covered.ok() && commits_.committed_revision() != snapshot->revision()) {
    num_unpublished_ = std::min(num_unpublished_, 1);
    publish_due_ = In(options_.commit_retry_s);
    return nullptr;
  }
  auto newest = shown_->Newest();
  if (newest->shared_snapshot() == snapshot) return newest;
  return std::make_shared<const MapView>(std::move(snapshot), newest.get());
}

/// Returns what is seen then.
std::shared_ptr<const MapView> MapSession::Publish() {
  auto view = MakeView();
  if (view == nullptr) {
    shown_->ShowNewest();
    return View();
  }
  shown_->Show(view);
  num_unpublished_ = 0;
  return view;
}

void MapSession::PublishPrepared() {
  auto view = MakeView();
  if (view == nullptr) return;
  shown_->ShowPrepared(std::move(view));
  num_unpublished_ = 0;
  show_due_ = In(std::min(options_.publish_s, options_.commit_s));  // nobody is told when it is seen
}

void MapSession::ReleaseNumbers() {
  const MapInfo& info = builder_.map().info();
  if (!commits_.last_outcome().ok() || commits_.committed_revision() != info.revision) return;
  numbers_.Release(info);
}

/// Not with a full sync: that comes with the commit of the change.
Status MapSession::CommitPublished() {
  const bool is_stored = commits_.committed_revision() == builder_.map().published()->revision();
  if (is_stored && !commits_.lacks_left()) return Status::Ok();
  std::promise<Status> outcome;
  RequestCommit(Durability::kNormal, [&outcome](const Status& status) { outcome.set_value(CopyOf(status)); });
  return outcome.get_future().get();
}

/// If it throws, what is to be stored still is, and `done` never runs.
void MapSession::RequestCommit(Durability durability, CommitWorker::Done done) {
  commits_.Request(builder_.map().published(), durability, std::move(done));
  num_uncommitted_ = 0;
  is_batch_waiting_ = false;
}

}  // namespace dhpmap
