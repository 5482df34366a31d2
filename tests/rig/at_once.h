// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <thread>
#include <vector>

namespace dhpmap::rig {

/// Runs attack(i), of each i below `count`, in as many threads at once, and waits for them.
inline void AtOnce(int count, const std::function<void(int)>& attack) {
  std::vector<std::jthread> threads;
  threads.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) threads.emplace_back(attack, i);
}

}  // namespace dhpmap::rig
