// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/submap_surface.h"

#include <algorithm>

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
  for (const Eigen::AlignedBox3d& box : boxes_m) {
    boxes.emplace_back((box.min() - origin_m_).cast<float>() - Eigen::Vector3f::Constant(rounding_m),
                       (box.max() - origin_m_).cast<float>() + Eigen::Vector3f::Constant(rounding_m));
  }
  tree_ = BoxTree(boxes);
  for (const std::uint32_t number : tree_.items()) tiles_.push_back(std::move(tiles[number]));
}

void SubmapSurface::AppendChanges(const SubmapSurface& before, std::vector<Eigen::AlignedBox3d>& boxes_m) const {
  const auto sorted = [](const SubmapSurface& surface) {
    std::vector<const Tile*> tiles;
    for (const Tile& tile : surface.tiles_) tiles.push_back(&tile);
    std::sort(tiles.begin(), tiles.end(), [](const Tile* a, const Tile* b) { return a->index < b->index; });
    return tiles;
  };
  const std::vector<const Tile*> old_tiles = sorted(before), new_tiles = sorted(*this);
  auto was = old_tiles.begin(), is = new_tiles.begin();
  while (was != old_tiles.end() || is != new_tiles.end()) {
    if (is == new_tiles.end() || (was != old_tiles.end() && (*was)->index < (*is)->index)) {
      boxes_m.push_back((*was++)->box_m);
    } else if (was == old_tiles.end() || (*is)->index < (*was)->index) {
      boxes_m.push_back((*is++)->box_m);
    } else {
      if ((*was)->slot != (*is)->slot) boxes_m.push_back((*was)->box_m.merged((*is)->box_m));
      ++was, ++is;
    }
  }
}

}  // namespace dhpmap
