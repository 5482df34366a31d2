// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Compiles a function for several vector units, up to 256 bits or (WIDE) 512, chosen at load time; not under
// sanitizers, which start after that choice. Its callees must be always-inline to use the wider unit. Results are
// identical: no contraction, see DhpmapTargets.cmake.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DHPMAP_SANITIZED)
#define DHPMAP_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#define DHPMAP_WIDE_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define DHPMAP_VECTOR_CLONES
#define DHPMAP_WIDE_VECTOR_CLONES
#endif
#define DHPMAP_ALWAYS_INLINE __attribute__((always_inline)) inline

// Put before a loop: GCC ignores restrict on local pointers, and compares only a few of them at run time.
#if defined(__GNUC__) && !defined(__clang__)
#define DHPMAP_NOTHING_OVERLAPS _Pragma("GCC ivdep")
#else
#define DHPMAP_NOTHING_OVERLAPS
#endif
