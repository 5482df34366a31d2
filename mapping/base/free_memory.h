// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace dhpmap {

/// Returns free memory of the allocator to the system, after work such as a refinement with a high peak. About a
/// millisecond for 4 MB. Supports glibc's malloc and jemalloc; may do nothing with others, such as those of sanitizers.
/// Thread-safe.
void GiveBackFreeMemory();

/// Heap bytes that an allocation of this size takes; approximate unless the allocator is jemalloc. Thread-safe.
[[nodiscard]] std::size_t HeapBytesFor(std::size_t bytes);

struct HeapUse {
  std::size_t live_bytes = 0;      ///< allocated and not yet freed
  std::size_t resident_bytes = 0;  ///< of the allocator, in RAM, with metadata, gaps and caches
};

/// Nothing unless the allocator is jemalloc, as under a sanitizer. Thread-safe.
[[nodiscard]] std::optional<HeapUse> HeapUseNow();

}  // namespace dhpmap
