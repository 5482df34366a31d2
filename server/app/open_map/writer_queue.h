// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/app/open_map/lazy_thread.h"
#include "server/app/open_map/shutting_down.h"

namespace dhpmap {

/// A job for a map's writer thread. It runs or is refused, exactly once; its exceptions are dropped.
struct WriterJob {
  std::function<void()> run;
  std::function<void(const Status&)> refuse;
  bool is_edit = false;  ///< counts as a pending edit while queued
};

/// Periodic work of the writer thread besides jobs. Must not throw.
struct WriterChores {
  using TimePoint = std::chrono::steady_clock::time_point;
  /// When `run` must run without a job; nothing: after the next job. Called under the queue's mutex: must be quick and
  /// not call back.
  std::function<std::optional<TimePoint>()> due;
  std::function<void()> run;     ///< after each job, and when due
  std::function<void()> finish;  ///< at the end, after all jobs have run or been refused
};

/// A map's FIFO queue of jobs and its single thread, which starts with the first job and retires when idle.
/// Thread-safe.
class WriterQueue {
 public:
  /// Further edits are refused with RESOURCE_EXHAUSTED, reason TOO_MANY_EDITS, while `max_pending_edits` are queued.
  WriterQueue(std::size_t max_pending_edits, WriterChores chores);
  /// Requires Stop.
  ~WriterQueue() = default;
  WriterQueue(const WriterQueue&) = delete;
  WriterQueue& operator=(const WriterQueue&) = delete;

  /// If it throws, the job neither runs nor is refused.
  void Post(WriterJob job) DHPMAP_EXCLUDES(mutex_);

  /// OK, or the error for later jobs.
  [[nodiscard]] Status refusal() const DHPMAP_EXCLUDES(mutex_);
  /// The error for a job that gives up because the map's mapping ends: the same, or ShuttingDown.
  [[nodiscard]] Status EndReason() const DHPMAP_EXCLUDES(mutex_);
  /// Refuses later jobs with `why`; queued ones still run.
  void Close(Status why) DHPMAP_EXCLUDES(mutex_);
  /// No job is running or queued.
  [[nodiscard]] bool IsAtRest() const DHPMAP_EXCLUDES(mutex_);

  /// Finishes the running job, refuses queued and later ones, runs the last chore if there ever was a job, and joins
  /// the thread. Returns the code of refusals: that of ShuttingDown, or of an earlier Close. One call at a time.
  StatusCode Stop() DHPMAP_EXCLUDES(mutex_);

 private:
  Status Start() DHPMAP_REQUIRES(mutex_);
  void Loop();
  [[nodiscard]] WriterJob Take() DHPMAP_REQUIRES(mutex_);
  /// Releases the mutex while the job runs.
  void RunOne() DHPMAP_REQUIRES(mutex_);
  void RefuseAll() DHPMAP_EXCLUDES(mutex_);

  const std::size_t max_pending_edits_;
  const WriterChores chores_;

  mutable Mutex mutex_;
  CondVar wake_;
  std::deque<WriterJob> jobs_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t num_pending_edits_ DHPMAP_GUARDED_BY(mutex_) = 0;
  Status refusal_ DHPMAP_GUARDED_BY(mutex_);           // not OK: jobs are refused
  bool is_running_ DHPMAP_GUARDED_BY(mutex_) = false;  // a job
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;

  LazyThread thread_;  // started and retired under the mutex; joined by Stop, after the last start
};

}  // namespace dhpmap
