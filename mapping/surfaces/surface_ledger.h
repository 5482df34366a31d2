// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace dhpmap {

/// Memory of a cache's surfaces, and the cache's clock. Thread-safe.
struct SurfaceLedger {
  std::atomic<std::size_t> bytes{0};       ///< of surfaces
  std::atomic<std::size_t> cell_bytes{0};  ///< of cached cells
  /// For the near fields of one map. Constant during concurrent reads.
  std::size_t most_field_bytes = std::numeric_limits<std::size_t>::max();
  std::atomic<std::uint64_t> time{1};
};

}  // namespace dhpmap
