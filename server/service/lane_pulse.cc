// SPDX-License-Identifier: BSD-3-Clause
#include "server/service/lane_pulse.h"

#include <utility>

namespace dhpmap::service {

LanePulse::LanePulse(Post post, std::function<void()> on_alive)
    : post_(std::move(post)), state_(std::make_shared<State>()) {
  state_->on_alive = std::move(on_alive);
}

void LanePulse::Beat() {
  {
    const MutexLock lock(state_->mutex);
    if (std::exchange(state_->is_under_way, true)) return;
  }
  const bool is_posted = post_([state = state_] {
    state->on_alive();
    const MutexLock lock(state->mutex);
    state->is_under_way = false;
  });
  if (is_posted) return;
  const MutexLock lock(state_->mutex);
  state_->is_under_way = false;
}

}  // namespace dhpmap::service
