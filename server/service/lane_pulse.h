// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "mapping/base/mutex.h"

namespace dhpmap::service {

/// Checks that a lane still runs its tasks. Each beat is a task of its own, queued behind the waiting ones.
/// Thread-safe.
class LanePulse {
 public:
  /// Runs its work on the lane, or returns false without keeping it.
  using Post = std::function<bool(std::function<void()> work)>;

  /// The lane calls `on_alive` when it runs a beat, even after this object is destroyed.
  LanePulse(Post post, std::function<void()> on_alive);

  /// Posts a beat, unless the previous one has not run yet. So a blocked lane holds at most one.
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
