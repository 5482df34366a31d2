// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// Gives the system back what the allocator holds of memory that is free: after work that took far more than what is
/// left of it, such as a refinement. Takes about a millisecond for 4 MB. Knows glibc's malloc and jemalloc; with
/// others, such as those of the sanitizers, it may do nothing. Thread-safe.
void GiveBackFreeMemory();

}  // namespace dhpmap
