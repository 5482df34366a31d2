// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/submap_surface.h"

#include <algorithm>
#include <numeric>

namespace dhpmap {
namespace {

/// Around the tile's blocks and one voxel more, as far as its cells reach; rounded outwards in the tree's floats.
Eigen::AlignedBox3d BoxOf(const TileEntry& tile, double voxel_size_m) {
  Eigen::AlignedBox3d box;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(voxel_size_m);
  for (const BlockEntry& block : tile.tile->entries()) {
    if (block.tsdf == nullptr) continue;
    const Eigen::Vector3d corner = BlockCorner(block.index, voxel_size_m);
    box.extend(corner - reach);
    box.extend(corner + kBlockSide * reach + reach);
  }
  return box;
}

}  // namespace

SubmapSurface::SubmapSurface(const Submap& submap, const SlotSource& slot_of) {
  const double voxel_size_m = submap.info().voxel_size_m;
  std::vector<Tile> tiles;
  std::vector<Eigen::AlignedBox3d> boxes_m;
  for (const TileEntry& entry : submap.blocks().tiles()) {
    const Eigen::AlignedBox3d box = BoxOf(entry, voxel_size_m);
    if (box.isEmpty()) continue;
    boxes_m.push_back(box);
    box_m_.extend(box);
    tiles.push_back({entry.index, TileCorner(entry.index, voxel_size_m), box,
                     slot_of(FindNeighbourhood(submap.blocks(), entry.index), entry.index)});
  }
  if (tiles.empty()) return;
  origin_m_ = box_m_.center();
  const float rounding_m = static_cast<float>(1e-6 * box_m_.sizes().norm());
  std::vector<Eigen::AlignedBox3f> boxes;
  boxes.reserve(boxes_m.size());
  for (const Eigen::AlignedBox3d& box : boxes_m) {
    boxes.emplace_back((box.min() - origin_m_).cast<float>() - Eigen::Vector3f::Constant(rounding_m),
                       (box.max() - origin_m_).cast<float>() + Eigen::Vector3f::Constant(rounding_m));
  }
  tree_ = BoxTree(boxes);
  for (const std::uint32_t number : tree_.items()) tiles_.push_back(std::move(tiles[number]));
  by_index_.resize(tiles_.size());
  std::iota(by_index_.begin(), by_index_.end(), 0u);
  std::sort(by_index_.begin(), by_index_.end(),
            [this](std::uint32_t a, std::uint32_t b) { return tiles_[a].index < tiles_[b].index; });
}

std::shared_ptr<const TileSurfaceSlot> SubmapSurface::SlotAt(TileIndex tile) const {
  const auto found = std::lower_bound(by_index_.begin(), by_index_.end(), tile,
                                      [this](std::uint32_t i, TileIndex t) { return tiles_[i].index < t; });
  return found != by_index_.end() && tiles_[*found].index == tile ? tiles_[*found].slot : nullptr;
}

void SubmapSurface::PrepareUsedSince(std::uint64_t time, const Submap& submap, const std::stop_token& stop) const {
  for (const Tile& tile : tiles_) {
    if (stop.stop_requested()) return;
    if (tile.slot->last_used() >= time) tile.slot->Prepare(submap.blocks(), tile.index);
  }
}

void SubmapSurface::AppendChanges(const SubmapSurface& before, std::vector<Eigen::AlignedBox3d>& boxes_m) const {
  auto was = before.by_index_.begin(), is = by_index_.begin();
  while (was != before.by_index_.end() && is != by_index_.end()) {
    const Tile &old_tile = before.tiles_[*was], &new_tile = tiles_[*is];
    if (old_tile.index < new_tile.index) {
      boxes_m.push_back(old_tile.box_m);
      ++was;
    } else if (new_tile.index < old_tile.index) {
      boxes_m.push_back(new_tile.box_m);
      ++is;
    } else {
      if (old_tile.slot != new_tile.slot) boxes_m.push_back(old_tile.box_m.merged(new_tile.box_m));
      ++was, ++is;
    }
  }
  for (; was != before.by_index_.end(); ++was) boxes_m.push_back(before.tiles_[*was].box_m);
  for (; is != by_index_.end(); ++is) boxes_m.push_back(tiles_[*is].box_m);
}

}  // namespace dhpmap
