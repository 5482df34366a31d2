// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Runs loops over independent items on a fixed set of threads. The caller's thread takes part, so a pool of one thread
/// starts none and runs everything in place. Thread-safe: loops of several callers share the threads item by item, and
/// a body may run a loop of its own.
class ThreadPool {
 public:
  /// `num_threads` counts the caller; 0 means one a core. Those that it starts are by `niceness` nicer than the
  /// process: see MakeThisThreadNicer.
  explicit ThreadPool(int num_threads, int niceness = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int num_threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(i) once for every i in [0, count) and returns when all are done. The order is not fixed, so a body that
  /// must give the same result for any number of threads writes only to what item i owns. If a body throws, items that
  /// have not begun are left out, and the first exception is the caller's once the others have ended.
  void ParallelFor(std::size_t count, const std::function<void(std::size_t)>& body) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Loop;

  void WorkerLoop(int niceness) DHPMAP_EXCLUDES(mutex_);
  /// Runs the next item of a loop that has one left. Lets go of the mutex while the body runs.
  void RunItem(Loop& loop) DHPMAP_REQUIRES(mutex_);
  /// No further item of it begins.
  void Close(Loop& loop) DHPMAP_REQUIRES(mutex_);

  Mutex mutex_;
  CondVar work_ready_;
  CondVar work_done_;
  std::vector<Loop*> open_ DHPMAP_GUARDED_BY(mutex_);  ///< with items left, each on its caller's stack
  std::size_t turn_ DHPMAP_GUARDED_BY(mutex_) = 0;     ///< workers go around the open loops
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;

  std::vector<std::thread> workers_;
};

}  // namespace dhpmap
