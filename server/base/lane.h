// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/this_thread.h"

namespace dhpmap {

/// Work that waits for a thread and can be cancelled until it starts. Thread-safe.
class LaneTask {
 public:
  /// `work` answers its own callers; only LaneOptions::on_exception sees its exceptions.
  explicit LaneTask(std::function<void()> work) : work_(std::move(work)) {}

  /// True if the work had not started: it is freed and will never run.
  bool GiveUp() DHPMAP_EXCLUDES(mutex_);

 private:
  friend class Lane;
  [[nodiscard]] bool IsGivenUp() const DHPMAP_EXCLUDES(mutex_);
  /// Takes the work to start it; empty if cancelled.
  [[nodiscard]] std::function<void()> Take() DHPMAP_EXCLUDES(mutex_);

  mutable Mutex mutex_;
  std::function<void()> work_ DHPMAP_GUARDED_BY(mutex_);
};

struct LaneOptions {
  const char* name = "lane";  ///< of its threads
  int num_threads = 1;
  std::size_t max_waiting = 1024;  ///< limit of tasks that have not started
  int niceness = 0;                ///< of its threads, relative to the process: 10 leaves the cores to others
  Turns turns = Turns::kOrdinary;
  /// Called on the lane's thread with the exception of a task. Empty: logs to standard error.
  std::function<void(const char* what)> on_exception = {};
};

/// Threads and a FIFO queue for work of one kind, so that kinds do not wait for each other and the few network threads
/// are never blocked. Survives exceptions of tasks. Thread-safe.
class Lane {
 public:
  explicit Lane(const LaneOptions& options);
  /// Runs all posted tasks, then ends the threads.
  ~Lane();
  Lane(const Lane&) = delete;
  Lane& operator=(const Lane&) = delete;

  /// False, without keeping the task, if max_waiting tasks that are not cancelled wait.
  [[nodiscard]] bool TryPost(std::shared_ptr<LaneTask> task) DHPMAP_EXCLUDES(mutex_);
  /// Like TryPost, for work that pins a state of a map and continues in further tasks. It starts when no other task
  /// waits, so that running work ends first and unpins its state, but after kLongestLast at the latest.
  [[nodiscard]] bool TryPostLast(std::shared_ptr<LaneTask> task) DHPMAP_EXCLUDES(mutex_);
  /// For work that its source bounds, such as the frames in flight of a stream: never refused.
  void Post(std::function<void()> work) DHPMAP_EXCLUDES(mutex_);
  void Post(std::shared_ptr<LaneTask> task) DHPMAP_EXCLUDES(mutex_);

  /// Spreads items over the caller's thread and idle threads of the lane; if the lane is busy, the caller does all. If
  /// a body throws, remaining items are skipped, and the caller gets the first exception after running ones have ended.
  void Share(std::size_t count, const std::function<void(std::size_t)>& body) DHPMAP_EXCLUDES(mutex_);

 private:
  class Shared;
  using Clock = std::chrono::steady_clock;
  /// Longest delay of a TryPostLast task by others.
  static constexpr std::chrono::seconds kLongestLast{5};
  struct Last {
    std::shared_ptr<LaneTask> task;
    Clock::time_point due;
  };

  void Loop() DHPMAP_EXCLUDES(mutex_);
  void Run(LaneTask& task) const DHPMAP_EXCLUDES(mutex_);
  void TellException(const char* what) const noexcept;
  [[nodiscard]] bool HasRoom() DHPMAP_REQUIRES(mutex_);
  [[nodiscard]] std::shared_ptr<LaneTask> TakeNext() DHPMAP_REQUIRES(mutex_);

  const LaneOptions options_;
  Mutex mutex_;
  CondVar wake_;
  std::deque<std::shared_ptr<LaneTask>> tasks_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Last> last_ DHPMAP_GUARDED_BY(mutex_);
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::vector<std::thread> threads_;
};

}  // namespace dhpmap
