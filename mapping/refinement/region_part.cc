// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/region_part.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

/// Blocks of one submap.
class PartOfSubmap {
 public:
  PartOfSubmap(const Submap& whole, const RegionPart& part)
      : part_(part), cut_(std::make_shared<Submap>(whole.info(), whole.generation())) {
    cut_->set_bounding_sphere(whole.bounding_sphere());
    for (const TileEntry& tile : whole.blocks().tiles()) AddOf(tile);
  }
  std::shared_ptr<const Submap> Take() { return std::move(cut_); }

 private:
  void AddOf(const TileEntry& tile) {
    const std::span<const BlockEntry> blocks = tile.tile->entries();
    const auto is_in_part = [this](const BlockEntry& block) { return part_.Has(block.index); };
    if (std::all_of(blocks.begin(), blocks.end(), is_in_part)) return cut_->PutTile(tile.index, tile.tile);
    const auto some = std::make_shared<BlockTile>();
    for (const BlockEntry& block : blocks) {
      if (!is_in_part(block) && !IsFirstElsewhere(block)) continue;
      BlockEntry& copy = some->FindOrInsert(block.index);
      ForEachLayer([](BlockLayer, const auto& from, auto& to) { to = from; }, block, copy);
    }
    if (!some->empty()) cut_->PutTile(tile.index, some);
  }

  bool IsFirstElsewhere(const BlockEntry& block) {
    if (has_one_elsewhere_ || block.tsdf == nullptr || !block.tsdf->HasObservedVoxel()) return false;
    return has_one_elsewhere_ = true;
  }

  const RegionPart& part_;
  std::shared_ptr<Submap> cut_;
  bool has_one_elsewhere_ = false;
};

}  // namespace

Map GoOnFrom(const MapSnapshot& state, const RegionPart& part) {
  std::vector<std::shared_ptr<const Submap>> submaps;
  submaps.reserve(state.submaps().size());
  for (const auto& submap : state.submaps())
    submaps.push_back(part.IsAll() ? submap : PartOfSubmap(*submap, part).Take());
  const auto own = std::make_shared<MapSnapshot>(state.info(), std::move(submaps));
  Map map(own);
  *own = MapSnapshot(state.info(), {});  // nobody else has seen it, and the map must not keep it
  return map;
}

}  // namespace dhpmap
