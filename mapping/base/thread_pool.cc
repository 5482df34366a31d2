// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/thread_pool.h"

#include <algorithm>
#include <exception>

#include "mapping/base/this_thread.h"

namespace dhpmap {

/// What a caller of ParallelFor waits for. Belongs to the pool's mutex.
struct ThreadPool::Loop {
  const std::function<void(std::size_t)>& body;
  std::size_t count;
  std::size_t next = 0;
  std::size_t num_running = 0;
  std::exception_ptr error = nullptr;  ///< the first

  [[nodiscard]] bool IsOpen() const { return next < count; }
  [[nodiscard]] bool IsDone() const { return !IsOpen() && num_running == 0; }
};

ThreadPool::ThreadPool(int num_threads, int niceness) {
  if (num_threads <= 0) num_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (int i = 1; i < num_threads; ++i) workers_.emplace_back([this, niceness] { WorkerLoop(niceness); });
}

ThreadPool::~ThreadPool() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  work_ready_.NotifyAll();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::ParallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (count == 0) return;
  if (workers_.empty() || count == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  Loop loop{.body = body, .count = count};
  {
    const MutexLock lock(mutex_);
    open_.push_back(&loop);
    work_ready_.NotifyAll();
    while (loop.IsOpen()) RunItem(loop);
    while (!loop.IsDone()) work_done_.Wait(mutex_);
  }
  if (loop.error) std::rethrow_exception(loop.error);
}

void ThreadPool::RunItem(Loop& loop) {
  const std::size_t item = loop.next++;
  ++loop.num_running;
  if (!loop.IsOpen()) std::erase(open_, &loop);
  mutex_.Unlock();
  std::exception_ptr error;
  try {
    loop.body(item);
  } catch (...) {
    error = std::current_exception();
  }
  mutex_.Lock();
  if (error && !loop.error) {
    loop.error = error;
    Close(loop);
  }
  --loop.num_running;
  if (loop.IsDone()) work_done_.NotifyAll();
}

void ThreadPool::Close(Loop& loop) {
  loop.next = loop.count;
  std::erase(open_, &loop);
}

void ThreadPool::WorkerLoop(int niceness) {
  NameThisThread("pool");
  MakeThisThreadNicer(niceness);
  (void)TakeTurns(Turns::kOrdinary);  // whoever made the pool
  const MutexLock lock(mutex_);
  while (true) {
    while (!stopping_ && open_.empty()) work_ready_.Wait(mutex_);
    if (stopping_) return;
    RunItem(*open_[turn_++ % open_.size()]);
  }
}

}  // namespace dhpmap
