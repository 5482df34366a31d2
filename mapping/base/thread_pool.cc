// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/thread_pool.h"

#include <algorithm>

namespace dhpmap {

ThreadPool::ThreadPool(int num_threads) {
  if (num_threads <= 0) num_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (int i = 1; i < num_threads; ++i) workers_.emplace_back([this] { WorkerLoop(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_ready_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::ParallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (count == 0) return;
  if (workers_.empty() || count == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  std::unique_lock lock(mutex_);
  body_ = &body;
  next_ = 0;
  count_ = count;
  unfinished_ = count;
  work_ready_.notify_all();
  RunItems(lock);
  work_done_.wait(lock, [this] { return unfinished_ == 0; });
  body_ = nullptr;
}

void ThreadPool::RunItems(std::unique_lock<std::mutex>& lock) {
  while (body_ != nullptr && next_ < count_) {
    const std::size_t item = next_++;
    const auto& body = *body_;
    lock.unlock();
    body(item);
    lock.lock();
    if (--unfinished_ == 0) work_done_.notify_all();
  }
}

void ThreadPool::WorkerLoop() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_ready_.wait(lock, [this] { return stopping_ || (body_ != nullptr && next_ < count_); });
    if (stopping_) return;
    RunItems(lock);
  }
}

}  // namespace dhpmap
