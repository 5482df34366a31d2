// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/crf_tiles.h"

#include <algorithm>
#include <map>
#include <optional>

#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

/// The only label of some voxels, if there is just one.
struct SoleLabel {
  bool is_disputed = false;
  std::optional<std::uint32_t> class_id, instance;

  void Add(const SoleLabel& other) {
    const auto differ = [](const auto& a, const auto& b) { return a && b && *a != *b; };
    is_disputed =
        is_disputed || other.is_disputed || differ(class_id, other.class_id) || differ(instance, other.instance);
    if (!class_id) class_id = other.class_id;
    if (!instance) instance = other.instance;
  }
};

SoleLabel LabelOf(const HeldBlock& block) {
  SoleLabel sole;
  const LabelBlock& labels = *block.entry->labels;
  for (int i = 0; i < kBlockVoxels && !sole.is_disputed; ++i) {
    labels.VisitClasses(i, [&](LabelCount seen) { sole.Add({.class_id = seen.id}); });
    labels.VisitInstances(
        i, [&](LabelCount seen) { sole.Add({.instance = seen.id == 0 ? block.holder.value : seen.id}); });
  }
  return sole;
}

constexpr std::int32_t FloorDiv(std::int32_t a, std::int32_t b) { return (a >= 0 ? a : a - b + 1) / b; }

}  // namespace

std::vector<HeldBlock> CollectBlocks(std::span<const SubmapId> ids, const Map& map) {
  std::vector<HeldBlock> blocks;
  for (const SubmapId id : ids) {
    const Submap* submap = map.Find(id);
    if (submap == nullptr || !IsOnMapGrid(submap->info(), map.info().config)) continue;
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.tsdf && entry.labels) blocks.push_back({entry.index, id, &entry});
    }
  }
  std::sort(blocks.begin(), blocks.end(), [](const HeldBlock& a, const HeldBlock& b) {
    return a.index != b.index ? a.index < b.index : a.holder < b.holder;
  });
  return blocks;
}

std::vector<CrfTile> CutTiles(std::span<const HeldBlock> blocks, int side, int rim) {
  std::map<BlockIndex, CrfTile> tiles;  // by tile coordinates: ordered, so that the result is
  std::map<BlockIndex, SoleLabel> sole;
  for (std::uint32_t i = 0; i < blocks.size(); ++i) {
    const BlockIndex b = blocks[i].index;
    const SoleLabel label = LabelOf(blocks[i]);
    const BlockIndex home{FloorDiv(b.x, side), FloorDiv(b.y, side), FloorDiv(b.z, side)};
    const BlockIndex low{FloorDiv(b.x - rim, side), FloorDiv(b.y - rim, side), FloorDiv(b.z - rim, side)};
    const BlockIndex high{FloorDiv(b.x + rim, side), FloorDiv(b.y + rim, side), FloorDiv(b.z + rim, side)};
    for (BlockIndex t = low; t.x <= high.x; ++t.x) {
      for (t.y = low.y; t.y <= high.y; ++t.y) {
        for (t.z = low.z; t.z <= high.z; ++t.z) {
          CrfTile& tile = tiles[t];
          (t == home ? tile.inner : tile.rim).push_back(i);
          sole[t].Add(label);
        }
      }
    }
  }
  std::vector<CrfTile> disputed;
  for (auto& [index, tile] : tiles) {
    if (!tile.inner.empty() && sole[index].is_disputed) disputed.push_back(std::move(tile));
  }
  return disputed;
}

void DropUnchanged(std::span<const HeldBlock> blocks, const MapSnapshot& before, std::vector<CrfTile>& tiles) {
  const auto is_unchanged = [&](std::uint32_t b) {
    const Submap* holder = before.Find(blocks[b].holder);
    const BlockEntry* old = holder != nullptr ? holder->blocks().Find(blocks[b].index) : nullptr;
    return old != nullptr && old->tsdf == blocks[b].entry->tsdf && old->labels == blocks[b].entry->labels;
  };
  std::erase_if(tiles, [&](const CrfTile& tile) {
    return std::all_of(tile.inner.begin(), tile.inner.end(), is_unchanged) &&
           std::all_of(tile.rim.begin(), tile.rim.end(), is_unchanged);
  });
}

}  // namespace dhpmap
