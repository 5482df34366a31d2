// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_queue.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMaxReadAhead = 4;

}  // namespace

FrameQueue::FrameQueue(Dataset& dataset, std::vector<std::size_t> indices, bool has_persistent_ids,
                       OnSkipped on_skipped)
    : thread_([this, &dataset, indices = std::move(indices), has_persistent_ids, on_skipped = std::move(on_skipped)] {
        Run(dataset, indices, has_persistent_ids, on_skipped);
      }) {}

FrameQueue::~FrameQueue() {
  Stop();
  thread_.join();
}

void FrameQueue::Run(Dataset& dataset, const std::vector<std::size_t>& indices, bool has_persistent_ids,
                     const OnSkipped& on_skipped) {
  for (std::size_t index : indices) {
    const Result<DatasetFrame> frame = dataset.Read(index);
    if (!frame.ok()) {
      on_skipped(index, frame.status());
    } else if (!Push({index, ToMessage(*frame, has_persistent_ids)})) {
      return;
    }
  }
  const MutexLock lock(mutex_);
  is_complete_ = true;
  changed_.NotifyAll();
}

bool FrameQueue::Push(QueuedFrame frame) {
  const MutexLock lock(mutex_);
  while (!is_stopped_ && frames_.size() >= kMaxReadAhead) changed_.Wait(mutex_);
  if (is_stopped_) return false;
  frames_.push_back(std::move(frame));
  changed_.NotifyAll();
  return true;
}

std::optional<QueuedFrame> FrameQueue::Next() {
  const MutexLock lock(mutex_);
  while (!is_stopped_ && !is_complete_ && frames_.empty()) changed_.Wait(mutex_);
  if (is_stopped_ || frames_.empty()) return std::nullopt;
  QueuedFrame frame = std::move(frames_.front());
  frames_.pop_front();
  changed_.NotifyAll();
  return frame;
}

void FrameQueue::Stop() {
  const MutexLock lock(mutex_);
  is_stopped_ = true;
  changed_.NotifyAll();
}

}  // namespace dhpmap
