// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stop_token>

namespace dhpmap {

/// Calls body(i) once for every i in [0, count), in any order and on whichever threads, and returns when all have
/// ended.
using Spread = std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

/// The Spread that runs everything in place.
inline void InPlace(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

/// The same for many long items in batches, so that helpers become free for other work in between. Some are left out
/// after a `stop` request.
inline void InParts(std::size_t count, const Spread& spread, const std::stop_token& stop,
                    const std::function<void(std::size_t)>& body) {
  constexpr std::size_t kAtOnce = 64;
  for (std::size_t begin = 0; begin < count && !stop.stop_requested(); begin += kAtOnce) {
    spread(std::min(kAtOnce, count - begin), [&](std::size_t i) {
      if (!stop.stop_requested()) body(begin + i);
    });
  }
}

}  // namespace dhpmap
