// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/tile_labels.h"

#include <cstddef>

#include "mapping/base/memory_count.h"

namespace dhpmap {

void TileLabels::AddTo(LabelTotals& totals) const {
  if (!classes.empty() && classes.back().first >= totals.classes.size())
    totals.classes.resize(classes.back().first + 1);
  for (const auto& [id, count] : classes) totals.classes[id] += count;
  totals.own += own;
  totals.instances += instances;
}

TileLabels LabelsOf(std::span<const BlockEntry> blocks) {
  LabelTotals totals;
  for (const BlockEntry& block : blocks) {
    if (block.labels) block.labels->AddTo(totals);
  }
  TileLabels labels{.classes = {}, .own = totals.own, .instances = totals.instances};
  for (std::size_t id = 0; id < totals.classes.size(); ++id) {
    if (totals.classes[id] != 0) labels.classes.emplace_back(static_cast<std::uint32_t>(id), totals.classes[id]);
  }
  labels.classes.shrink_to_fit();
  return labels;
}

const TileLabels& KeptTileLabels::Keep(TileLabels labels) const {
  auto made = std::make_unique<const TileLabels>(std::move(labels));
  const TileLabels* kept = nullptr;
  if (kept_.compare_exchange_strong(kept, made.get(), std::memory_order_acq_rel)) return *made.release();
  return *kept;
}

std::size_t KeptTileLabels::MemoryBytes() const {
  const TileLabels* labels = Find();
  return labels == nullptr ? 0 : sizeof(*labels) + CapacityBytes(labels->classes);
}

}  // namespace dhpmap
