// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_session.h"

#include <algorithm>
#include <exception>
#include <future>
#include <string>
#include <utility>

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

/// What an edit is answered when it is done but could not be made durable.
Status NotStored(const Status& cause) {
  return Status(cause.code(), "the change is made, but is not in the store yet: " + cause.message())
      .WithReason(cause.reason().empty() ? "NOT_STORED" : cause.reason());
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

}  // namespace

MapSession::MapSession(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, SessionOptions options)
    : options_(WithClock(std::move(options))),
      commits_(store, snapshot, options_.commit_retry_s, options_.on_commit),
      builder_(snapshot, options_.num_threads, RefinementTiming::kNeverWait),
      view_(std::make_shared<const MapView>(snapshot)) {
  writer_ = std::thread([this] { WriterLoop(); });
}

MapSession::~MapSession() { (void)Stop(); }

std::shared_ptr<const MapView> MapSession::View() const {
  const std::lock_guard lock(view_mutex_);
  return view_;
}

Status MapSession::BeginFeed() {
  const std::lock_guard lock(mutex_);
  if (!refusal_.ok()) return refusal_;
  if (is_fed_) return Aborted("another stream feeds this map already").WithReason("MAP_IS_FED");
  is_fed_ = true;
  return Status::Ok();
}

void MapSession::EndFeed() {
  const std::lock_guard lock(mutex_);
  is_fed_ = false;
}

void MapSession::Integrate(Result<PanopticFrame> frame, std::function<void(FrameOutcome)> done) {
  auto shared = std::make_shared<Result<PanopticFrame>>(std::move(frame));
  Post({.run = [this, shared, done] { done(IntegrateNow(std::move(*shared))); },
        .refuse =
            [this, done](const Status& status) {
              done({.report = status,
                    .revision = View()->snapshot().revision(),
                    .commit_status = commits_.last_outcome()});
            }});
}

void MapSession::Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done) {
  auto run = [this, change = std::move(change), done] {
    Publish();  // so that revisions and etags of what the change meets are those of its present state
    auto submap = Guarded<Result<SubmapId>>([&] { return change(builder_.map()); });
    if (!submap.ok()) return done(submap.status());
    EditOutcome outcome{.view = Publish(), .submap = *submap};
    RequestCommit(Durability::kFull, [done, outcome = std::move(outcome)](const Status& status) {
      if (status.ok()) done(outcome);
      else done(NotStored(status));
    });
  };
  Post({.run = std::move(run), .refuse = [done](const Status& status) { done(status); }, .is_edit = true});
}

void MapSession::Flush(std::function<void(const Status&)> done) {
  auto run = [this, done] {
    Publish();
    RequestCommit(Durability::kNormal, done);
  };
  Post({.run = std::move(run), .refuse = done});
}

void MapSession::Finish(std::function<void(Result<FinishOutcome>)> done) {
  auto run = [this, done] {
    const auto refinement =
        Guarded<Result<RefinementReport>>([this]() -> Result<RefinementReport> { return builder_.Finish(); });
    if (!refinement.ok()) return done(refinement.status());
    if (options_.on_refinement) options_.on_refinement(*refinement);
    FinishOutcome outcome{.view = Publish(), .refinement = *refinement};
    RequestCommit(Durability::kFull, [done, outcome = std::move(outcome)](const Status& status) {
      if (status.ok()) done(outcome);
      else done(NotStored(status));
    });
  };
  Post({.run = std::move(run), .refuse = [done](const Status& status) { done(status); }, .is_edit = true});
}

Status MapSession::DeleteFromStore() {
  Status fed = BeginFeed();  // nobody may start feeding meanwhile
  if (fed.code() == StatusCode::kAborted) {
    return FailedPrecondition("frames are being streamed into this map").WithReason("MAP_IS_FED");
  }
  DHPMAP_RETURN_IF_ERROR(std::move(fed));
  std::promise<Status> outcome;
  commits_.DeleteMap([&outcome](const Status& status) { outcome.set_value(status); });
  const Status status = outcome.get_future().get();
  const std::lock_guard lock(mutex_);
  if (status.ok()) refusal_ = NotFound("the map has been deleted").WithReason("MAP_NOT_FOUND");
  is_fed_ = false;
  return status;
}

Status MapSession::Stop() {
  const std::lock_guard stop_lock(stop_mutex_);  // of two callers the second waits for the end, too
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    if (refusal_.ok()) refusal_ = ShuttingDown();
  }
  wake_.notify_one();
  if (writer_.joinable()) writer_.join();
  commits_.Stop();
  return commits_.last_outcome();
}

void MapSession::Post(Job job) {
  Status refused;
  {
    const std::lock_guard lock(mutex_);
    refused = refusal_;
    if (refused.ok() && job.is_edit && num_pending_edits_ >= options_.max_pending_edits) {
      refused = ResourceExhausted("too many edits wait for this map").WithReason("TOO_MANY_EDITS");
    }
    if (refused.ok()) {
      num_pending_edits_ += job.is_edit ? 1 : 0;
      jobs_.push_back(std::move(job));
    }
  }
  if (refused.ok()) wake_.notify_one();
  else job.refuse(refused);
}

void MapSession::WriterLoop() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const auto is_ready = [this] { return stopping_ || !jobs_.empty(); };
    if (num_unpublished_ > 0) {
      wake_.wait_until(lock, std::min(publish_due_, commit_due_), is_ready);
    } else if (num_uncommitted_ > 0) {
      wake_.wait_until(lock, commit_due_, is_ready);
    } else {
      wake_.wait(lock, is_ready);
    }
    if (!stopping_ && !jobs_.empty()) RunOne(lock);
    lock.unlock();
    DoBatchesThatAreDue();
    lock.lock();
  }
  const std::deque<Job> refused = std::exchange(jobs_, {});
  const Status status = refusal_;
  lock.unlock();
  for (const Job& job : refused) job.refuse(status);
  Publish();
  RequestCommit(Durability::kFull);
}

void MapSession::RunOne(std::unique_lock<std::mutex>& lock) {
  {
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    num_pending_edits_ -= job.is_edit ? 1 : 0;
    lock.unlock();
    job.run();
  }
  lock.lock();
}

void MapSession::DoBatchesThatAreDue() {
  const auto now = Clock::now();
  if (num_uncommitted_ > 0 && (num_uncommitted_ >= options_.commit_frames || now >= commit_due_)) {
    Publish();
    RequestCommit(Durability::kNormal);
  } else if (num_unpublished_ > 0 && (num_unpublished_ >= options_.publish_frames || now >= publish_due_)) {
    Publish();
  }
}

FrameOutcome MapSession::IntegrateNow(Result<PanopticFrame> frame) {
  FrameOutcome outcome{.report = frame.ok() ? Guarded<Result<FrameReport>>([&] { return builder_.Integrate(*frame); })
                                            : frame.status()};
  if (outcome.report.ok()) {
    if (outcome.report->refinement && options_.on_refinement) options_.on_refinement(*outcome.report->refinement);
    if (num_unpublished_++ == 0) publish_due_ = In(options_.publish_s);
    if (num_uncommitted_++ == 0) commit_due_ = In(options_.commit_s);
    DoBatchesThatAreDue();
  }
  outcome.revision = View()->snapshot().revision();
  outcome.is_committed = num_unpublished_ == 0 && commits_.committed_revision() == outcome.revision;
  outcome.commit_status = commits_.last_outcome();
  return outcome;
}

std::shared_ptr<const MapView> MapSession::Publish() {
  num_unpublished_ = 0;
  auto snapshot = builder_.map().Publish(options_.now_ns());
  auto view = View();
  if (view->shared_snapshot() == snapshot) return view;
  auto next = std::make_shared<const MapView>(std::move(snapshot));
  const std::lock_guard lock(view_mutex_);
  view_.swap(next);  // `view` still holds the old one: nothing is freed under the lock
  return view_;
}

void MapSession::RequestCommit(Durability durability, CommitWorker::Done done) {
  num_uncommitted_ = 0;
  commits_.Request(View()->shared_snapshot(), durability, std::move(done));
}

}  // namespace dhpmap
