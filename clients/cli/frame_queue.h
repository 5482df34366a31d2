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

/// Reads ahead a few frames of a data set on its own thread. Thread-safe.
class FrameQueue {
 public:
  /// Called on the reading thread for each skipped frame.
  using OnSkipped = std::function<void(std::size_t index, const Status& why)>;

  /// `dataset` must outlive the queue, and must not be used meanwhile.
  FrameQueue(Dataset& dataset, std::vector<std::size_t> indices, bool has_persistent_ids, OnSkipped on_skipped);
  ~FrameQueue();

  /// Waits for the next frame; empty after the last one, and after Stop.
  std::optional<QueuedFrame> Next();
  /// Ends reading; drops frames that were read already.
  void Stop();

 private:
  void Run(Dataset& dataset, const std::vector<std::size_t>& indices, bool has_persistent_ids,
           const OnSkipped& on_skipped);
  /// Waits for space. False once stopped.
  bool Push(QueuedFrame frame) DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  CondVar changed_;
  std::deque<QueuedFrame> frames_ DHPMAP_GUARDED_BY(mutex_);
  bool is_complete_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< no more frames follow
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace dhpmap
