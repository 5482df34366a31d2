// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "mapping/base/thread_pool.h"

namespace dhpmap {

/// ParallelFor over items that need memory: body(i) once for every i in [0, sizes.size()), where those under way at a
/// time have at most `most_at_once` of size together; a larger one runs alone. `sizes` descend, and the largest that
/// fits comes next, so that small ones fill up what large ones leave. If a body throws, as ParallelFor. The body must
/// not wait for another item.
void BoundedParallelFor(ThreadPool& pool, std::span<const std::size_t> sizes, std::size_t most_at_once,
                        const std::function<void(std::size_t)>& body);

}  // namespace dhpmap
