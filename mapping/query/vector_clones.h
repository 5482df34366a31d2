// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Functions so marked exist for several vector units, chosen at load time; not under sanitizers, which start after the
// choice. What is to use the wider unit with them must be always inline.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DHPMAP_SANITIZED)
#define DHPMAP_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define DHPMAP_VECTOR_CLONES
#endif
#define DHPMAP_ALWAYS_INLINE __attribute__((always_inline)) inline
