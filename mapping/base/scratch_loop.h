// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/thread_pool.h"

namespace dhpmap {

/// ParallelFor with scratch memory: body(i, scratch) for every i in [0, count), with a scratch for each thread. Its
/// content from earlier items must not affect item i.
template <typename Scratch, typename Body>
void ParallelForWithScratch(ThreadPool& pool, std::size_t count, std::vector<Scratch>& scratch, const Body& body) {
  static_assert(alignof(Scratch) >= kCacheLineBytes, "those of two threads lie side by side");
  const auto num_lanes = static_cast<std::size_t>(pool.num_threads());
  if (scratch.size() < num_lanes) scratch.resize(num_lanes);
  struct alignas(kCacheLineBytes) Counter {  // on its own cache line: every thread reads its neighbours
    std::atomic<std::size_t> next{0};
  } counter;
  pool.ParallelFor(num_lanes, [&](std::size_t lane) {
    for (std::size_t i = counter.next++; i < count; i = counter.next++) body(i, scratch[lane]);
  });
}

}  // namespace dhpmap
