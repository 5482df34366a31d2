// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/tile_labels.h"

#include <algorithm>
#include <utility>

#include "mapping/base/memory_count.h"

namespace dhpmap {

void TileLabels::AddTo(LabelTotals& totals) const {
  for (const auto& [id, count] : classes) totals.AddClass(id, count);
  totals.own += own;
  totals.instances += instances;
}

TileLabels LabelsOf(std::span<const BlockEntry> blocks) {
  thread_local std::vector<std::uint64_t> zeros;  // ids may be large, and there are many tiles
  LabelTotals totals;
  totals.classes.swap(zeros);
  for (const BlockEntry& block : blocks) {
    if (block.labels) block.labels->AddTo(totals);
  }
  std::sort(totals.seen.begin(), totals.seen.end());
  TileLabels labels{.classes = {}, .own = totals.own, .instances = totals.instances};
  labels.classes.reserve(totals.seen.size());
  for (const std::uint32_t id : totals.seen) labels.classes.emplace_back(id, std::exchange(totals.classes[id], 0));
  zeros.swap(totals.classes);
  return labels;
}

void KeptTileLabels::Keep(TileLabels labels) const {
  auto made = std::make_unique<const TileLabels>(std::move(labels));
  const TileLabels* kept = nullptr;
  if (kept_.compare_exchange_strong(kept, made.get(), std::memory_order_acq_rel)) (void)made.release();
}

std::size_t KeptTileLabels::MemoryBytes() const {
  const TileLabels* labels = Find();
  return labels == nullptr ? 0 : sizeof(*labels) + CapacityBytes(labels->classes);
}

}  // namespace dhpmap
