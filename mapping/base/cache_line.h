// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace dhpmap {

/// What one thread writes often and another reads or writes beside it lies so far apart: else each takes the line from
/// the other with every write, and two threads are no faster than one. That holds for the heads of vectors that grow,
/// too. A thread's own copy, which is moved to where it belongs at the end, does as well.
inline constexpr std::size_t kCacheLineBytes = 64;

}  // namespace dhpmap
