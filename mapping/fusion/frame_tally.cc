// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/frame_tally.h"

namespace dhpmap {

void FrameTally::NoteRuns(const std::vector<PointRun>& runs) {
  if (num_runs_.fetch_add(runs.size(), std::memory_order_relaxed) + runs.size() <= kMaxBlocksAFrame) return;
  std::size_t num_new = 0;
  const PointRun* last = nullptr;
  for (const PointRun& run : runs) {
    if (last == nullptr || BlockOf(last->place.voxel()) != BlockOf(run.place.voxel()))
      num_new += IsNew(BlockOf(run.place.voxel()));
    last = &run;
  }
  if (num_blocks_.fetch_add(num_new, std::memory_order_relaxed) + num_new > kMaxBlocksAFrame) {
    is_too_large_.store(true, std::memory_order_relaxed);
  }
}

bool FrameTally::IsNew(BlockIndex block) {
  const std::size_t bit = BlockIndexHash{}(block) & (kNumWords * kWordBits - 1);
  std::atomic<std::uint64_t>& word = blocks_seen_[bit / kWordBits];
  const std::uint64_t mask = std::uint64_t{1} << bit % kWordBits;
  if ((word.load(std::memory_order_relaxed) & mask) != 0) return false;
  return (word.fetch_or(mask, std::memory_order_relaxed) & mask) == 0;
}

}  // namespace dhpmap
