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

/// Counts the blocks and cells of a frame while it is processed. Thread-safe. The count at which processing stops
/// depends on the threads; whether a frame is too large does not.
class FrameTally {
 public:
  /// A frame of few points cannot have too many cells, so its blocks are not counted.
  explicit FrameTally(std::size_t num_points) : blocks_seen_(num_points > kMaxBlocksAFrame ? kNumWords : 0) {}

  [[nodiscard]] bool is_too_large() const { return is_too_large_.load(std::memory_order_relaxed); }

  /// Call it before the cells are counted one by one. Enough blocks imply enough cells, so most runs of a frame of
  /// noise are never made. Costs nothing until the number of runs reaches the limit of cells.
  void NoteRuns(const std::vector<PointRun>& runs);

  /// Call it before a cell is made; false: do not make it.
  [[nodiscard]] bool TakeCell() {
    if (num_cells_.fetch_add(1, std::memory_order_relaxed) < kMaxBlocksAFrame) return true;
    is_too_large_.store(true, std::memory_order_relaxed);
    return false;
  }

 private:
  static constexpr std::size_t kWordBits = 64;
  static constexpr std::size_t kNumWords = 16 * kMaxBlocksAFrame / kWordBits;  // 256 kB: 3 % of the blocks share a bit

  /// Linear counting: one bit per block, chosen by its hash. Blocks that share a bit count once, so the sum is never
  /// too large.
  [[nodiscard]] bool IsNew(BlockIndex block);

  std::vector<std::atomic<std::uint64_t>> blocks_seen_;
  std::atomic<std::size_t> num_runs_ = 0, num_blocks_ = 0;
  std::atomic<bool> is_too_large_ = false;
  alignas(kCacheLineBytes) std::atomic<std::size_t> num_cells_ = 0;
};

}  // namespace dhpmap
