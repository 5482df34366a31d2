// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/grid.h"
#include "mapping/fusion/band_size.h"
#include "mapping/fusion/point_run.h"

namespace dhpmap {

/// How large a frame turns out to be while it is taken apart. Thread-safe. How much of a frame was seen when it is
/// found too large depends on the threads; whether it is found too large does not.
class FrameTally {
 public:
  /// A frame of so few points cannot have too many cells before its cells are made.
  explicit FrameTally(std::size_t num_points) : blocks_seen_(num_points > kMaxBlocksAFrame ? kNumWords : 0) {}

  [[nodiscard]] bool is_too_large() const { return is_too_large_.load(std::memory_order_relaxed); }

  /// Before the cells are counted one by one: enough blocks mean enough cells, so that most runs of a frame of noise
  /// are never made. Costs nothing until there are as many runs as there may be cells.
  void NoteRuns(const std::vector<PointRun>& runs);

  /// Before a cell is made; false: it must not be.
  [[nodiscard]] bool TakeCell() {
    if (num_cells_.fetch_add(1, std::memory_order_relaxed) < kMaxBlocksAFrame) return true;
    is_too_large_.store(true, std::memory_order_relaxed);
    return false;
  }

 private:
  static constexpr std::size_t kWordBits = 64;
  static constexpr std::size_t kNumWords = 16 * kMaxBlocksAFrame / kWordBits;  // 256 kB: 3 % of the blocks share a bit

  /// Linear counting: a bit a block, by its hash. Blocks that share one count once, so the sum is never too large.
  [[nodiscard]] bool IsNew(BlockIndex block);

  std::vector<std::atomic<std::uint64_t>> blocks_seen_;
  std::atomic<std::size_t> num_runs_ = 0, num_blocks_ = 0;
  std::atomic<bool> is_too_large_ = false;
  alignas(kCacheLineBytes) std::atomic<std::size_t> num_cells_ = 0;
};

}  // namespace dhpmap
