// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Functions so marked exist for several vector units, of up to 256 bits or (WIDE) 512, chosen at load time; not under
// sanitizers, which start after the choice. What is to use the wider unit with them must be always inline. The results
// are the same with all of them: nothing is contracted, see DhpmapTargets.cmake.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DHPMAP_SANITIZED)
#define DHPMAP_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#define DHPMAP_WIDE_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define DHPMAP_VECTOR_CLONES
#define DHPMAP_WIDE_VECTOR_CLONES
#endif
#define DHPMAP_ALWAYS_INLINE __attribute__((always_inline)) inline

// Before a loop. What local pointers promise of each other is not believed, and many are not compared at run time.
#if defined(__GNUC__) && !defined(__clang__)
#define DHPMAP_NOTHING_OVERLAPS _Pragma("GCC ivdep")
#else
#define DHPMAP_NOTHING_OVERLAPS
#endif
