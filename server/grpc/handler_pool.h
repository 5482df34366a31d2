// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace dhpmap {

/// Threads on which handlers run, so that work and disk never hold up gRPC's own threads, of which there are two. What
/// waits is bounded by the number of open calls. Thread-safe.
class HandlerPool {
 public:
  explicit HandlerPool(int num_threads);
  /// Runs what was posted, then ends the threads.
  ~HandlerPool();
  HandlerPool(const HandlerPool&) = delete;
  HandlerPool& operator=(const HandlerPool&) = delete;

  /// `task` must not throw.
  void Post(std::function<void()> task);

 private:
  void Loop();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;  // guarded by mutex_
  bool stopping_ = false;                    // guarded by mutex_
  std::vector<std::thread> threads_;
};

}  // namespace dhpmap
