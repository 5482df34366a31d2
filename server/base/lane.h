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

/// Work that waits for a thread and can be given up as long as it does. Thread-safe.
class LaneTask {
 public:
  /// What `work` throws nobody gets but LaneOptions::on_exception: it answers its own callers.
  explicit LaneTask(std::function<void()> work) : work_(std::move(work)) {}

  /// True if the work had not begun: then it is freed, and never will.
  bool GiveUp() DHPMAP_EXCLUDES(mutex_);

 private:
  friend class Lane;
  [[nodiscard]] bool IsGivenUp() const DHPMAP_EXCLUDES(mutex_);
  /// The work, to be begun now; empty if it is given up.
  [[nodiscard]] std::function<void()> Take() DHPMAP_EXCLUDES(mutex_);

  mutable Mutex mutex_;
  std::function<void()> work_ DHPMAP_GUARDED_BY(mutex_);
};

struct LaneOptions {
  const char* name = "lane";  ///< of its threads
  int num_threads = 1;
  std::size_t max_waiting = 1024;  ///< tasks that no thread has begun
  int niceness = 0;                ///< of its threads, above that of the process: 10 leaves the cores to others
  Turns turns = Turns::kOrdinary;
  /// Hears, on the lane's thread, what a task has thrown. Empty: standard error gets a line.
  std::function<void(const char* what)> on_exception = {};
};

/// Threads for work of one kind, in the order it came, so that no kind waits for another, and none holds up the few
/// threads that hear of what arrives. It outlives what its tasks throw. Thread-safe.
class Lane {
 public:
  explicit Lane(const LaneOptions& options);
  /// Runs what was posted, then ends the threads.
  ~Lane();
  Lane(const Lane&) = delete;
  Lane& operator=(const Lane&) = delete;

  /// False, and nothing is kept, if max_waiting tasks wait that nobody has given up.
  [[nodiscard]] bool TryPost(std::shared_ptr<LaneTask> task) DHPMAP_EXCLUDES(mutex_);
  /// The same for work that takes a state of a map and goes on with it in other tasks. It begins when nothing else
  /// waits, so that what has begun ends first and lets go of its state; but it does not wait for ever.
  [[nodiscard]] bool TryPostLast(std::shared_ptr<LaneTask> task) DHPMAP_EXCLUDES(mutex_);
  /// For work that its source bounds, such as the frames in flight of a stream: there is always room for it.
  void Post(std::function<void()> work) DHPMAP_EXCLUDES(mutex_);
  void Post(std::shared_ptr<LaneTask> task) DHPMAP_EXCLUDES(mutex_);

  /// Spread (see there) over the caller's thread and those of the lane that come to it meanwhile: with a busy lane the
  /// caller does it alone. If a body throws, items that have not begun are left out, and the caller gets the first
  /// exception once the others have ended.
  void Share(std::size_t count, const std::function<void(std::size_t)>& body) DHPMAP_EXCLUDES(mutex_);

 private:
  class Shared;
  using Clock = std::chrono::steady_clock;
  /// How long others may go before one of TryPostLast.
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
