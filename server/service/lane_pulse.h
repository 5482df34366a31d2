// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "mapping/base/mutex.h"

namespace dhpmap::service {

/// Whether a lane still runs what is posted to it: each beat goes through it as a task of its own, behind those that
/// wait there. Thread-safe.
class LanePulse {
 public:
  /// Runs its work on the lane, or returns false without keeping it.
  using Post = std::function<bool(std::function<void()> work)>;

  /// `on_alive` runs on the lane with each beat that has come through, also when this is gone.
  LanePulse(Post post, std::function<void()> on_alive);

  /// Sends a beat, unless one is still on its way: a lane that stands still gets no more of them.
  void Beat();

 private:
  struct State {
    std::function<void()> on_alive;
    Mutex mutex;
    bool is_under_way DHPMAP_GUARDED_BY(mutex) = false;
  };

  const Post post_;
  const std::shared_ptr<State> state_;
};

}  // namespace dhpmap::service
