// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/map_finisher.h"

#include <atomic>
#include <chrono>
#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

/// The error if a finished map could not be made durable.
Status NotStoredYet(const Status& cause) {
  return Status(cause.code(), "the map is finished, but is not in the store yet: " + cause.message())
      .WithReason(cause.reason().empty() ? Reason("NOT_STORED") : cause.reason());
}

Status NobodyWaitsForTheEnd() {
  return Cancelled("nobody waits for the end of mapping any longer: the map is as it was");
}

}  // namespace

struct MapFinisher::Call {
  Clock::time_point begin = Clock::now();
  FinishStage stage = FinishStage::kWaiting;  ///< guarded by mutex_
  std::atomic<bool> is_taken = false;

  /// True for the first caller only, so that exactly one of writer, refusal and cancellation answers.
  bool Take() { return !is_taken.exchange(true); }
};

void MapFinisher::TellProgress() const {
  if (on_finishing_) TellSafely(on_finishing_);
}

void MapFinisher::SetStage(const std::shared_ptr<Call>& call, FinishStage stage) {
  {
    const MutexLock lock(mutex_);
    call->stage = stage;
  }
  TellProgress();
}

void MapFinisher::End(const std::shared_ptr<Call>& call) {
  {
    const MutexLock lock(mutex_);
    std::erase(calls_, call);
  }
  TellProgress();
}

std::optional<FinishProgress> MapFinisher::Progress() const {
  const MutexLock lock(mutex_);
  if (calls_.empty()) return std::nullopt;
  const Call& first = *calls_.front();
  return FinishProgress{first.stage, std::chrono::duration<double>(Clock::now() - first.begin).count()};
}

void MapFinisher::Finish(Done done, std::stop_token stop) {
  const auto call = std::make_shared<Call>();
  {
    const MutexLock lock(mutex_);
    calls_.push_back(call);
  }
  TellProgress();
  try {
    Post(call, std::move(done), std::move(stop));
  } catch (...) {
    if (!call->Take()) return;  // cancelled meanwhile, and answered
    End(call);
    throw;
  }
}

void MapFinisher::Post(const std::shared_ptr<Call>& call, Done on_done, std::stop_token stop) {
  const auto done = [this, call, on_done = std::move(on_done)](Result<FinishOutcome> outcome) {
    End(call);  // before the caller is informed
    TellSafely([&] { on_done(std::move(outcome)); });
  };
  // Checks the token while the job waits. The callback is destroyed with the job, before the open map.
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
  writer_.queue.Post({.run = std::move(run), .refuse = std::move(refuse), .is_edit = true});
}

/// On a failure or exception `done` is not called.
Status MapFinisher::FinishAndStore(const std::shared_ptr<Call>& call, const std::stop_token& stop, const Done& done) {
  SetStage(call, FinishStage::kRefining);
  DHPMAP_ASSIGN_OR_RETURN(const RefinementReport refinement, Refine(stop));
  writer_.batches.NoteChange();  // if it fails below, the next batch stores it
  SetStage(call, FinishStage::kStoring);
  if (on_refinement_) TellSafely([&] { on_refinement_(refinement); });
  writer_.recording.Note([](FrameRecorder& recorder) { recorder.OnFinished(); });
  const Status failed = Guarded<Status>([&] {
    FinishOutcome outcome{.view = writer_.publisher.Publish(), .refinement = refinement};
    writer_.committer.Request(writer_.map().published(), Durability::kFull,
                              [done, outcome = std::move(outcome)](const Status& status) mutable {
                                if (status.ok()) done(std::move(outcome));
                                else done(Guarded<Status>([&status] { return NotStoredYet(status); }));
                              });
    return Status::Ok();
  });
  return failed.ok() ? Status::Ok() : NotStoredYet(failed);
}

Result<RefinementReport> MapFinisher::Refine(const std::stop_token& stop) {
  const auto is_cancelled = [this, &stop] { return stop.stop_requested() || writer_.give_up.stop_requested(); };
  const auto report = writer_.builder.Finish(is_cancelled);
  if (report) return *report;
  if (writer_.give_up.stop_requested()) return writer_.queue.EndReason();
  return NobodyWaitsForTheEnd();
}

}  // namespace dhpmap
