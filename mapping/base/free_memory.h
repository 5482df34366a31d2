// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace dhpmap {

/// Gives the system back what the allocator holds of memory that is free: after work that took far more than what is
/// left of it, such as a refinement. Takes about a millisecond for 4 MB. Knows glibc's malloc and jemalloc; with
/// others, such as those of the sanitizers, it may do nothing. Thread-safe.
void GiveBackFreeMemory();

/// What the allocator takes for one piece of so many bytes: more or less, where it is not jemalloc. Thread-safe.
[[nodiscard]] std::size_t HeapBytesFor(std::size_t bytes);

struct HeapUse {
  std::size_t live_bytes = 0;      ///< handed out and not yet freed
  std::size_t resident_bytes = 0;  ///< of the allocator, in RAM: with its book-keeping, gaps and what is kept for later
};

/// Nothing where the allocator is not jemalloc, as in programs under a sanitizer. Thread-safe.
[[nodiscard]] std::optional<HeapUse> HeapUseNow();

}  // namespace dhpmap
