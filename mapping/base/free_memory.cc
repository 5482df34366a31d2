// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/free_memory.h"

#include <malloc.h>

#include <cstddef>

// jemalloc's, in programs that are linked with it.
extern "C" __attribute__((weak)) int mallctl(const char* name, void* old_value, std::size_t* old_bytes, void* new_value,
                                             std::size_t new_bytes);

namespace dhpmap {

void GiveBackFreeMemory() {
  if (mallctl != nullptr) {
    mallctl("arena.4096.purge", nullptr, nullptr, nullptr, 0);  // MALLCTL_ARENAS_ALL
  } else {
    malloc_trim(0);
  }
}

}  // namespace dhpmap
