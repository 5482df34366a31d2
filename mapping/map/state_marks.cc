// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/state_marks.h"

#include <algorithm>

namespace dhpmap {
namespace {

template <typename Layer>
bool IsSame(const std::weak_ptr<const Layer>& mark, const std::shared_ptr<const Layer>& layer) {
  return !mark.owner_before(layer) && !layer.owner_before(mark);
}

}  // namespace

StateMarks::StateMarks(const MapSnapshot& state) {
  for (const auto& submap : state.submaps()) {
    std::vector<Block>& blocks = submaps_[submap->id()];
    blocks.reserve(submap->blocks().size());
    for (const BlockEntry& entry : submap->blocks().entries()) {
      blocks.push_back({.index = entry.index, .tsdf = entry.tsdf, .labels = entry.labels, .gone = entry.gone});
    }
    std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.index < b.index; });
  }
}

bool StateMarks::Has(SubmapId submap, const BlockEntry& entry) const {
  const auto found = submaps_.find(submap);
  if (found == submaps_.end()) return false;
  const std::vector<Block>& blocks = found->second;
  const auto block = std::lower_bound(blocks.begin(), blocks.end(), entry.index,
                                      [](const Block& a, BlockIndex wanted) { return a.index < wanted; });
  return block != blocks.end() && block->index == entry.index && IsSame(block->tsdf, entry.tsdf) &&
         IsSame(block->labels, entry.labels) && IsSame(block->gone, entry.gone);
}

}  // namespace dhpmap
