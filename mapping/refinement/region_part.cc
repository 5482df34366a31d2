// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/region_part.h"

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

/// Cuts the blocks of one submap.
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
    std::size_t num_in_part = 0;
    for (std::uint64_t left = tile.tile->cells(); left != 0; left &= left - 1) {
      num_in_part += part_.Has(BlockIn(tile.index, std::countr_zero(left))) ? 1u : 0u;
    }
    if (num_in_part == tile.tile->size()) return cut_->PutTile(tile.index, tile.tile);
    if (num_in_part == 0 && has_one_elsewhere_) return;  // nothing of it is needed or read
    const auto some = std::make_shared<BlockTile>();
    for (const BlockEntry& block : tile.tile->entries()) {
      if (!part_.Has(block.index) && !IsFirstElsewhere(block)) continue;
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
  *own = MapSnapshot(state.info(), {});  // only this function refers to it, and the map must not keep it
  return map;
}

}  // namespace dhpmap
