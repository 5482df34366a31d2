// SPDX-License-Identifier: BSD-3-Clause
// How jemalloc, which the server is linked with, treats memory that is free. Mapping and deleting the sample apartment
// three times in turn leaves 1,673 MB of anonymous memory with glibc's malloc, 489 with one arena of it, 408 with
// mimalloc, 381 with jemalloc as it comes, and 56 so, in the same CPU time.
extern "C" {
// Few arenas, since threads that free are seldom those that allocate; pages go back a tenth of a second after they were
// last used: with bulk clients beside mapping some 130 MB less than after a second, and nothing is slower (a twentieth
// is). Threads keep only small pieces for themselves, for there are many threads: 20 MB less. What a block's large
// layers are cut from holds a whole number of them (6 and 4 KiB), is large enough that jemalloc's notes on it, which it
// never gives back, stay small (as it comes, 84 MB after 1,000 maps had been open), and small enough to go back with
// old states of a map: beside bulk clients 10 to 30 MB less than with 64 KiB for all.
extern const char* malloc_conf;
const char* malloc_conf =
    "narenas:4,background_thread:true,dirty_decay_ms:100,muzzy_decay_ms:0,tcache_max:2048,"
    "slab_sizes:1025-4096:8|4097-5120:10|5121-6144:6|6145-14336:16";
}
