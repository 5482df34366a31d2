// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace dhpmap {

/// Runs loops over independent items on a fixed set of threads. The caller's thread takes part, so a pool of one thread
/// starts none and runs everything in place. One loop at a time: not for concurrent callers.
class ThreadPool {
 public:
  /// `num_threads` counts the caller; 0 means one a core.
  explicit ThreadPool(int num_threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int num_threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(i) once for every i in [0, count) and returns when all are done. The order is not fixed, so a body that
  /// must give the same result for any number of threads writes only to what item i owns. The body must not throw.
  void ParallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

 private:
  void WorkerLoop();
  void RunItems(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable work_ready_;
  std::condition_variable work_done_;
  // Guarded by mutex_.
  const std::function<void(std::size_t)>* body_ = nullptr;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::size_t unfinished_ = 0;
  bool stopping_ = false;

  std::vector<std::thread> workers_;
};

}  // namespace dhpmap
