// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace dhpmap {

/// Calls body(i) once for every i in [0, count), in any order and on whichever threads, and returns when all have
/// ended.
using Spread = std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

/// The Spread that runs everything in place.
inline void InPlace(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace dhpmap
