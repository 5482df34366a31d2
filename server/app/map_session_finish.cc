// SPDX-License-Identifier: BSD-3-Clause
// The part of a session that ends mapping.
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "mapping/base/guarded.h"
#include "server/app/map_session.h"

namespace dhpmap {
namespace {

/// What is answered when a finished map could not be made durable.
Status NotStoredYet(const Status& cause) {
  return Status(cause.code(), "the map is finished, but is not in the store yet: " + cause.message())
      .WithReason(cause.reason().empty() ? Reason("NOT_STORED") : cause.reason());
}

Status NobodyWaitsForTheEnd() {
  return Cancelled("nobody waits for the end of mapping any longer: the map is as it was");
}

}  // namespace

struct MapSession::FinishCall {
  TimePoint begin = TimePoint::clock::now();
  FinishStage stage = FinishStage::kWaiting;  ///< guarded by mutex_
  std::atomic<bool> is_taken = false;

  /// False to all but the first: the writer, the one who refuses it, and the caller who has gone answer it once.
  bool Take() { return !is_taken.exchange(true); }
};

void MapSession::SetStage(const std::shared_ptr<FinishCall>& call, FinishStage stage) {
  {
    const MutexLock lock(mutex_);
    call->stage = stage;
  }
  if (options_.on_finishing) TellSafely(options_.on_finishing);
}

void MapSession::EndFinish(const std::shared_ptr<FinishCall>& call) {
  {
    const MutexLock lock(mutex_);
    std::erase(finish_calls_, call);
  }
  if (options_.on_finishing) TellSafely(options_.on_finishing);
}

std::optional<FinishProgress> MapSession::Finishing() const {
  const MutexLock lock(mutex_);
  if (finish_calls_.empty()) return std::nullopt;
  const FinishCall& first = *finish_calls_.front();
  return FinishProgress{first.stage, std::chrono::duration<double>(TimePoint::clock::now() - first.begin).count()};
}

void MapSession::Finish(std::function<void(Result<FinishOutcome>)> done, std::stop_token stop) {
  const auto call = std::make_shared<FinishCall>();
  {
    const MutexLock lock(mutex_);
    finish_calls_.push_back(call);
  }
  if (options_.on_finishing) TellSafely(options_.on_finishing);
  try {
    PostFinish(call, std::move(done), std::move(stop));
  } catch (...) {
    if (!call->Take()) return;  // who has gone meanwhile is answered
    EndFinish(call);
    throw;
  }
}

void MapSession::PostFinish(const std::shared_ptr<FinishCall>& call, FinishDone on_done, std::stop_token stop) {
  const auto done = [this, call, on_done = std::move(on_done)](Result<FinishOutcome> outcome) {
    EndFinish(call);  // before the caller knows
    TellSafely([&] { on_done(std::move(outcome)); });
  };
  // While it waits nobody asks the token. Dropped with the job, so it is gone before the session is.
  using OnStop = std::stop_callback<std::function<void()>>;
  const auto on_stop = std::make_shared<OnStop>(stop, [call, done] {
    if (call->Take()) done(Guarded<Status>(NobodyWaitsForTheEnd));
  });
  auto run = [this, call, done, on_stop, stop = std::move(stop)] {
    if (!call->Take()) return;
    Status failed = Guarded<Status>([&] { return FinishAndStore(call, stop, done); });
    if (!failed.ok()) done(std::move(failed));
  };
  auto refuse = [call, done](const Status& status) {
    if (call->Take()) done(CopyOf(status));
  };
  Post({.run = std::move(run), .refuse = std::move(refuse), .is_edit = true});
}

/// If it fails or throws, `done` never runs.
Status MapSession::FinishAndStore(const std::shared_ptr<FinishCall>& call, const std::stop_token& stop,
                                  const FinishDone& done) {
  SetStage(call, FinishStage::kRefining);
  DHPMAP_ASSIGN_OR_RETURN(const RefinementReport refinement, FinishNow(stop));
  NoteChange();  // should it fail below, it is stored with the next batch
  SetStage(call, FinishStage::kStoring);
  if (options_.on_refinement) TellSafely([&] { options_.on_refinement(refinement); });
  if (recorder_ && *recorder_) TellSafely([this] { (*recorder_)->OnFinished(); });
  const Status failed = Guarded<Status>([&] {
    FinishOutcome outcome{.view = Publish(), .refinement = refinement};
    RequestCommit(Durability::kFull, [done, outcome = std::move(outcome)](const Status& status) mutable {
      if (status.ok()) done(std::move(outcome));
      else done(Guarded<Status>([&status] { return NotStoredYet(status); }));
    });
    return Status::Ok();
  });
  return failed.ok() ? Status::Ok() : NotStoredYet(failed);
}

Result<RefinementReport> MapSession::FinishNow(const std::stop_token& stop) {
  const auto is_cancelled = [this, &stop] { return stop.stop_requested() || end_.stop_requested(); };
  const auto report = builder_.Finish(is_cancelled);
  if (report) return *report;
  if (end_.stop_requested()) return ShuttingDown();
  return NobodyWaitsForTheEnd();
}

}  // namespace dhpmap
