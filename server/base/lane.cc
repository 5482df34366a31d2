// SPDX-License-Identifier: BSD-3-Clause
#include "server/base/lane.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <utility>

#include "mapping/base/this_thread.h"

namespace dhpmap {
bool LaneTask::GiveUp() {
  return Take() != nullptr;  // its captures are freed here, without the lock
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
      (void)TakeTurns(options_.turns);
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
  const MutexLock lock(mutex_);
  if (!HasRoom()) return false;
  tasks_.push_back(std::move(task));
  wake_.NotifyOne();  // under the lock: after it is released, the task may run and destroy the lane
  return true;
}

bool Lane::TryPostLast(std::shared_ptr<LaneTask> task) {
  const MutexLock lock(mutex_);
  if (!HasRoom()) return false;
  last_.push_back({.task = std::move(task), .due = Clock::now() + kLongestLast});
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
  const MutexLock lock(mutex_);
  tasks_.push_back(std::move(task));
  wake_.NotifyOne();
}

/// Items that several threads take one by one. A thread that comes after the last item touches no body.
class Lane::Shared {
 public:
  Shared(std::size_t count, const std::function<void(std::size_t)>& body) : count_(count), body_(body) {}

  void TakeAll() DHPMAP_EXCLUDES(mutex_) {
    MutexLock lock(mutex_);
    while (next_ < count_) {
      const std::size_t item = next_++;
      ++num_running_;
      lock.Unlock();
      std::exception_ptr thrown;
      try {
        body_(item);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.Lock();
      if (thrown != nullptr) {
        if (first_ == nullptr) first_ = thrown;
        next_ = count_;
      }
      if (--num_running_ == 0) ended_.NotifyAll();
    }
  }
  /// Waits for items that other threads have taken.
  void Wait() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    ended_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return num_running_ == 0; });
    if (first_ != nullptr) std::rethrow_exception(first_);
  }

 private:
  const std::size_t count_;
  const std::function<void(std::size_t)>& body_;  ///< valid until the last item has been taken and has ended
  Mutex mutex_;
  CondVar ended_;
  std::size_t next_ DHPMAP_GUARDED_BY(mutex_) = 0;
  int num_running_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::exception_ptr first_ DHPMAP_GUARDED_BY(mutex_);
};

void Lane::Share(std::size_t count, const std::function<void(std::size_t)>& body) {
  const auto shared = std::make_shared<Shared>(count, body);
  const std::size_t num_helpers = std::min(count, threads_.size());
  try {
    for (std::size_t i = 1; i < num_helpers; ++i) Post([shared] { shared->TakeAll(); });
  } catch (const std::bad_alloc&) {
    // Helpers that were posted may be running: wait for them below.
  }
  shared->TakeAll();
  shared->Wait();
}

/// Catches exceptions: one that leaves the thread would end the process.
void Lane::Run(LaneTask& task) const {
  const auto work = task.Take();
  if (!work) return;
  try {
    work();
  } catch (const std::exception& error) {
    TellException(error.what());
  } catch (...) {
    TellException("an exception of an unknown type");
  }
}

void Lane::TellException(const char* what) const noexcept {
  try {
    if (options_.on_exception) return options_.on_exception(what);
  } catch (...) {
    // on_exception may have run out of memory; the line below needs none.
  }
  (void)std::fprintf(stderr, "a task of the lane '%s' has thrown: %s\n", options_.name, what);
}

void Lane::Loop() {
  MutexLock lock(mutex_);
  while (true) {
    wake_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !tasks_.empty() || !last_.empty(); });
    if (tasks_.empty() && last_.empty()) return;
    {
      const std::shared_ptr<LaneTask> task = TakeNext();
      lock.Unlock();
      Run(*task);
    }
    lock.Lock();
  }
}

}  // namespace dhpmap
