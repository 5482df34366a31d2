// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace dhpmap {

/// What the surfaces of a cache take, and its clock. Thread-safe.
struct SurfaceLedger {
  std::atomic<std::size_t> bytes{0};       ///< of surfaces
  std::atomic<std::size_t> cell_bytes{0};  ///< of NearbyCells
  std::atomic<std::uint64_t> time{1};
};

}  // namespace dhpmap
