// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <initializer_list>

namespace dhpmap {

/// A state with transitions restricted by `IsLegal(State from, State to)`, declared next to the enum. Any other
/// transition is a bug of this program, never a client's: builds with assertions (dev, sanitizers) abort.
/// Thread-compatible.
template <typename State>
class StateMachine {
 public:
  constexpr explicit StateMachine(State first) : state_(first) {}

  constexpr void To(State next) {
    assert(IsLegal(state_, next));
    state_ = next;
  }
  [[nodiscard]] constexpr State state() const { return state_; }
  [[nodiscard]] constexpr bool Is(State state) const { return state_ == state; }
  [[nodiscard]] constexpr bool IsAnyOf(std::initializer_list<State> states) const {
    for (const State state : states) {
      if (state == state_) return true;
    }
    return false;
  }

 private:
  State state_;
};

}  // namespace dhpmap
