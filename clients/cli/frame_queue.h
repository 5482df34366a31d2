// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/cli/frame_message.h"
#include "mapping/base/mutex.h"

namespace dhpmap {

/// A frame ready to be sent.
struct QueuedFrame {
  std::size_t index = 0;  ///< in the data set
  v1::Frame message;
};

/// Reads frames of a data set ahead on a thread of its own, a few at most. Thread-safe.
class FrameQueue {
 public:
  /// Called on the reading thread for a frame that has to be skipped.
  using OnSkipped = std::function<void(std::size_t index, const Status& why)>;

  /// `dataset` must outlive the queue and be left alone meanwhile.
  FrameQueue(Dataset& dataset, std::vector<std::size_t> indices, bool has_persistent_ids, OnSkipped on_skipped);
  ~FrameQueue();

  /// Waits for the next frame; empty after the last one and after Stop.
  std::optional<QueuedFrame> Next();
  /// Ends reading; frames read already are dropped.
  void Stop();

 private:
  void Run(Dataset& dataset, const std::vector<std::size_t>& indices, bool has_persistent_ids,
           const OnSkipped& on_skipped);
  /// Waits for room. False once stopped.
  bool Push(QueuedFrame frame) DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  CondVar changed_;
  std::deque<QueuedFrame> frames_ DHPMAP_GUARDED_BY(mutex_);
  bool is_complete_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< nothing more will come
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace dhpmap
