// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace dhpmap {

/// Alignment against false sharing: data that one thread writes often must not share a cache line with data of another
/// thread, or two threads are no faster than one. This applies to the heads of growing vectors, too. A thread-local
/// copy, moved to its place at the end, serves as well.
inline constexpr std::size_t kCacheLineBytes = 64;

}  // namespace dhpmap
