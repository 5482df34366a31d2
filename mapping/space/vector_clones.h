// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Versions for wider vector units, chosen at load time. Not under sanitizers: those start after the choice. The results
// are the same with all of them: nothing is contracted, see DhpmapTargets.cmake.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DHPMAP_SANITIZED)
#define DHPMAP_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define DHPMAP_VECTOR_CLONES
#endif
