// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Parallel loops over independent items on a fixed set of threads. The caller takes part, so a pool of one thread
/// starts none. Thread-safe: loops of several callers share the threads item by item, and a body may run its own loop.
class ThreadPool {
 public:
  /// `num_threads` includes the caller; 0 means one a core. The started threads have `niceness` above the process's:
  /// see MakeThisThreadNicer.
  explicit ThreadPool(int num_threads, int niceness = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int num_threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(i) once for every i in [0, count) and returns when all are done. The order is unspecified, so a
  /// deterministic body writes only data of item i. If a body throws, remaining items are skipped, and the caller gets
  /// the first exception once running ones have ended.
  void ParallelFor(std::size_t count, const std::function<void(std::size_t)>& body) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Loop;

  void WorkerLoop(int niceness) DHPMAP_EXCLUDES(mutex_);
  /// Runs the next item of a loop that has one left. Releases the mutex while the body runs.
  void RunItem(Loop& loop) DHPMAP_REQUIRES(mutex_);
  /// Prevents further items from starting.
  void Close(Loop& loop) DHPMAP_REQUIRES(mutex_);

  Mutex mutex_;
  CondVar work_ready_;
  CondVar work_done_;
  std::vector<Loop*> open_ DHPMAP_GUARDED_BY(mutex_);  ///< loops with items left, each on its caller's stack
  std::size_t turn_ DHPMAP_GUARDED_BY(mutex_) = 0;     ///< round-robin position of the workers over the open loops
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;

  std::vector<std::thread> workers_;
};

}  // namespace dhpmap
