// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/app/session/lazy_thread.h"
#include "server/app/session/shutting_down.h"

namespace dhpmap {

/// A piece of work for a map's writer thread. It runs or is refused, exactly once; what it throws is dropped.
struct WriterJob {
  std::function<void()> run;
  std::function<void(const Status&)> refuse;
  bool is_edit = false;  ///< counts as a pending edit while it waits
};

/// What the writer thread does besides jobs. Must not throw.
struct WriterChores {
  using TimePoint = std::chrono::steady_clock::time_point;
  /// When `run` must run even if no job comes; nothing: with the next job. Called under the queue's mutex: quick, and
  /// must not call back.
  std::function<std::optional<TimePoint>()> due;
  std::function<void()> run;     ///< after each job, and when due
  std::function<void()> finish;  ///< at the end, when all jobs have run or been refused
};

/// The jobs of a map and the one thread that runs them, in the order of the calls. The thread begins with the first
/// job, and retires when there is nothing to do. Thread-safe.
class WriterQueue {
 public:
  /// More than `max_pending_edits` edits that wait are refused with RESOURCE_EXHAUSTED, reason TOO_MANY_EDITS.
  WriterQueue(std::size_t max_pending_edits, WriterChores chores);
  /// Stop must have been called.
  ~WriterQueue() = default;
  WriterQueue(const WriterQueue&) = delete;
  WriterQueue& operator=(const WriterQueue&) = delete;

  /// If it throws, the job neither runs nor is refused.
  void Post(WriterJob job) DHPMAP_EXCLUDES(mutex_);

  /// OK, or what later jobs are refused with.
  [[nodiscard]] Status refusal() const DHPMAP_EXCLUDES(mutex_);
  /// Refuses later jobs with `why`; those that wait still run.
  void Close(Status why) DHPMAP_EXCLUDES(mutex_);
  /// No job runs or waits.
  [[nodiscard]] bool IsAtRest() const DHPMAP_EXCLUDES(mutex_);

  /// Lets the job in hand end, refuses those that wait and all later ones, does the last chore if there ever was a job,
  /// and joins the thread. Returns the code that later jobs are refused with: that of ShuttingDown, or of an earlier
  /// Close. One call at a time.
  StatusCode Stop() DHPMAP_EXCLUDES(mutex_);

 private:
  Status Start() DHPMAP_REQUIRES(mutex_);
  void Loop();
  [[nodiscard]] WriterJob Take() DHPMAP_REQUIRES(mutex_);
  /// Lets go of the mutex while the job runs.
  void RunOne() DHPMAP_REQUIRES(mutex_);
  void RefuseAll() DHPMAP_EXCLUDES(mutex_);

  const std::size_t max_pending_edits_;
  const WriterChores chores_;

  mutable Mutex mutex_;
  CondVar wake_;
  std::deque<WriterJob> jobs_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t num_pending_edits_ DHPMAP_GUARDED_BY(mutex_) = 0;
  Status refusal_ DHPMAP_GUARDED_BY(mutex_);           // not OK: no more jobs are taken
  bool is_running_ DHPMAP_GUARDED_BY(mutex_) = false;  // a job
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;

  LazyThread thread_;  // started and retired under the mutex, joined by Stop, after which nobody starts it
};

}  // namespace dhpmap
