// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/free_memory.h"

#include <malloc.h>

#include <cstddef>
#include <cstdint>

// jemalloc's, in programs that are linked with it.
extern "C" __attribute__((weak)) int mallctl(const char* name, void* old_value, std::size_t* old_bytes, void* new_value,
                                             std::size_t new_bytes);
extern "C" __attribute__((weak)) std::size_t nallocx(std::size_t bytes, int flags);

namespace dhpmap {

void GiveBackFreeMemory() {
  if (mallctl != nullptr) {
    mallctl("arena.4096.purge", nullptr, nullptr, nullptr, 0);  // MALLCTL_ARENAS_ALL
  } else {
    malloc_trim(0);
  }
}

std::size_t HeapBytesFor(std::size_t bytes) {
  if (nallocx != nullptr) return nallocx(bytes, 0);
  constexpr std::size_t kHeadBytes = 8, kStep = 16;  // glibc's
  return (bytes + kHeadBytes + kStep - 1) / kStep * kStep;
}

std::optional<HeapUse> HeapUseNow() {
  if (mallctl == nullptr) return std::nullopt;
  std::uint64_t epoch = 1;
  mallctl("epoch", nullptr, nullptr, &epoch, sizeof epoch);  // what is read is what was at the last one
  HeapUse use;
  std::size_t num_bytes = sizeof(std::size_t);
  if (mallctl("stats.allocated", &use.live_bytes, &num_bytes, nullptr, 0) != 0 ||
      mallctl("stats.resident", &use.resident_bytes, &num_bytes, nullptr, 0) != 0) {
    return std::nullopt;
  }
  return use;
}

}  // namespace dhpmap
