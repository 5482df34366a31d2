// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/writer_queue.h"

#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/base/this_thread.h"

namespace dhpmap {

WriterQueue::WriterQueue(std::size_t max_pending_edits, WriterChores chores)
    : max_pending_edits_(max_pending_edits), chores_(std::move(chores)) {}

void WriterQueue::Post(WriterJob job) {
  Status refused;
  {
    const MutexLock lock(mutex_);
    refused = refusal_;
    if (refused.ok() && job.is_edit && num_pending_edits_ >= max_pending_edits_) {
      refused = ResourceExhausted("too many edits wait for this map").WithReason("TOO_MANY_EDITS");
    }
    if (refused.ok()) refused = Start();
    if (refused.ok()) {
      jobs_.push_back(std::move(job));
      num_pending_edits_ += jobs_.back().is_edit ? 1 : 0;
      wake_.NotifyOne();
      return;
    }
  }
  TellSafely([&] { job.refuse(refused); });
}

Status WriterQueue::refusal() const {
  const MutexLock lock(mutex_);
  return refusal_;
}

Status WriterQueue::EndReason() const {
  Status why = refusal();
  return why.ok() ? ShuttingDown() : why;
}

void WriterQueue::Close(Status why) {
  const MutexLock lock(mutex_);
  refusal_ = std::move(why);
}

bool WriterQueue::IsAtRest() const {
  const MutexLock lock(mutex_);
  return jobs_.empty() && !is_running_;
}

StatusCode WriterQueue::Stop() {
  StatusCode refusal{};
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
    if (refusal_.ok()) refusal_ = Guarded<Status>(ShuttingDown);
    refusal = refusal_.code();
    // Restarts an idle thread for the final work; if it never ran, nothing has changed.
    if (thread_.has_run()) (void)Guarded<Status>([this] { return thread_.Start([this] { Loop(); }); });
  }
  wake_.NotifyOne();
  thread_.Join();
  return refusal;
}

Status WriterQueue::Start() {
  return thread_.Start([this] { Loop(); });
}

void WriterQueue::Loop() {
  NameThisThread("map-writer");
  (void)TakeTurns(Turns::kOrdinary);  // a thread with quick turns has started this one
  MutexLock lock(mutex_);
  while (!stopping_) {
    const auto is_ready = [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !jobs_.empty(); };
    if (const auto due = chores_.due()) wake_.WaitUntil(mutex_, *due, is_ready);
    else if (!wake_.WaitFor(mutex_, LazyThread::kIdle, is_ready)) return thread_.Retire();
    if (!stopping_ && !jobs_.empty()) RunOne();
    lock.Unlock();
    chores_.run();
    lock.Lock();
  }
  lock.Unlock();
  RefuseAll();
  chores_.finish();
}

WriterJob WriterQueue::Take() {
  WriterJob job = std::move(jobs_.front());
  jobs_.pop_front();
  num_pending_edits_ -= job.is_edit ? 1 : 0;
  return job;
}

void WriterQueue::RunOne() {
  {
    const WriterJob job = Take();
    is_running_ = true;
    mutex_.Unlock();
    TellSafely(job.run);
  }
  mutex_.Lock();
  is_running_ = false;
}

void WriterQueue::RefuseAll() {
  MutexLock lock(mutex_);
  const Status status = CopyOf(refusal_);
  while (!jobs_.empty()) {
    {
      const WriterJob job = Take();
      lock.Unlock();
      TellSafely([&] { job.refuse(status); });
    }  // destroyed before the lock: its destructor may wait for a callback that needs the lock
    lock.Lock();
  }
}

}  // namespace dhpmap
