// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/lane.h"

#include <algorithm>
#include <utility>

#include "mapping/base/this_thread.h"

namespace dhpmap {
bool LaneTask::GiveUp() {
  return Take() != nullptr;  // what it held is freed here, outside of the lock
}

bool LaneTask::IsGivenUp() const {
  const MutexLock lock(mutex_);
  return work_ == nullptr;
}

std::function<void()> LaneTask::Take() {
  const MutexLock lock(mutex_);
  return std::exchange(work_, nullptr);
}

Lane::Lane(const LaneOptions& options) : options_(options) {
  for (int i = 0; i < std::max(1, options_.num_threads); ++i) {
    threads_.emplace_back([this] {
      NameThisThread(options_.name);
      MakeThisThreadNicer(options_.niceness);
      Loop();
    });
  }
}

Lane::~Lane() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  wake_.NotifyAll();
  for (std::thread& thread : threads_) thread.join();
}

bool Lane::TryPost(std::shared_ptr<LaneTask> task) {
  {
    const MutexLock lock(mutex_);
    if (!HasRoom()) return false;
    tasks_.push_back(std::move(task));
  }
  wake_.NotifyOne();
  return true;
}

bool Lane::TryPostLast(std::shared_ptr<LaneTask> task) {
  {
    const MutexLock lock(mutex_);
    if (!HasRoom()) return false;
    last_.push_back({.task = std::move(task), .due = Clock::now() + kLongestLast});
  }
  wake_.NotifyOne();
  return true;
}

bool Lane::HasRoom() {
  if (tasks_.size() + last_.size() < options_.max_waiting) return true;
  std::erase_if(tasks_, [](const std::shared_ptr<LaneTask>& waiting) { return waiting->IsGivenUp(); });
  std::erase_if(last_, [](const Last& waiting) { return waiting.task->IsGivenUp(); });
  return tasks_.size() + last_.size() < options_.max_waiting;
}

std::shared_ptr<LaneTask> Lane::TakeNext() {
  std::shared_ptr<LaneTask> task;
  if (tasks_.empty() || (!last_.empty() && last_.front().due <= Clock::now())) {
    task = std::move(last_.front().task);
    last_.pop_front();
  } else {
    task = std::move(tasks_.front());
    tasks_.pop_front();
  }
  return task;
}

void Lane::Post(std::function<void()> work) { Post(std::make_shared<LaneTask>(std::move(work))); }

void Lane::Post(std::shared_ptr<LaneTask> task) {
  {
    const MutexLock lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  wake_.NotifyOne();
}

void Lane::Loop() {
  MutexLock lock(mutex_);
  while (true) {
    wake_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !tasks_.empty() || !last_.empty(); });
    if (tasks_.empty() && last_.empty()) return;
    {
      const std::shared_ptr<LaneTask> task = TakeNext();
      lock.Unlock();
      if (const auto work = task->Take()) work();
    }
    lock.Lock();
  }
}

}  // namespace dhpmap
