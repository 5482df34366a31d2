// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/submap_surface.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace dhpmap {
namespace {

/// Bounds of the tile's blocks plus one voxel, the extent of its cells; rounded outwards in the tree's floats.
Eigen::AlignedBox3d BoxOf(const TileEntry& tile, double voxel_size_m) {
  Eigen::AlignedBox3d box;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(voxel_size_m);
  for (std::uint64_t left = tile.tile->CellsWith(BlockLayer::kTsdf); left != 0; left &= left - 1) {
    const Eigen::Vector3d corner = BlockCorner(BlockIn(tile.index, std::countr_zero(left)), voxel_size_m);
    box.extend(corner - reach);
    box.extend(corner + kBlockSide * reach + reach);
  }
  return box;
}

}  // namespace

SubmapSurface::SubmapSurface(const Submap& submap, const GridSharers* grid, const SubmapSurface* known,
                             const SlotSource& slots_of) {
  const double voxel_size_m = submap.info().voxel_size_m;
  std::vector<Tile> tiles;
  std::vector<Eigen::AlignedBox3d> boxes_m;
  std::vector<TilePlace> places;
  std::vector<std::size_t> wanted;  // tiles to make, by place
  for (const TileEntry& entry : submap.blocks().tiles()) {
    const Eigen::AlignedBox3d box = BoxOf(entry, voxel_size_m);
    if (box.isEmpty()) continue;
    boxes_m.push_back(box);
    box_m_.extend(box);
    tiles.push_back({.index = entry.index,
                     .corner_m = TileCorner(entry.index, voxel_size_m),
                     .box_m = box,
                     .slot = nullptr,
                     .around = grid == nullptr ? nullptr : grid->AroundOf(entry.index)});
    const Tile* before = known == nullptr ? nullptr : known->Find(entry.index);
    if (before != nullptr && IsAlike(*before, submap, grid)) {
      tiles.back().slot = before->slot;
      continue;
    }
    wanted.push_back(tiles.size() - 1);
    places.push_back({.tile = entry.index,
                      .owner = submap.id(),
                      .around = FindNeighbourhood(submap.blocks(), entry.index),
                      .sharers = {}});
    if (grid != nullptr) places.back().sharers = grid->SharersOf(submap.id(), entry.index);
  }
  if (tiles.empty()) return;
  Slots slots = slots_of(places);
  for (std::size_t i = 0; i < wanted.size(); ++i) tiles[wanted[i]].slot = std::move(slots[i]);
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

bool SubmapSurface::IsAlike(const Tile& tile, const Submap& submap, const GridSharers* grid) {
  if (grid == nullptr || tile.around == nullptr) return grid == nullptr && tile.around == nullptr;
  const std::shared_ptr<const GridSharers::Around>& now = grid->AroundOf(tile.index);
  return now == tile.around || (now != nullptr && now->IsAlikeFor(submap.id(), *tile.around));
}

bool SubmapSurface::IsOf(const Submap& submap, const GridSharers* grid) const {
  return std::all_of(tiles_.begin(), tiles_.end(), [&](const Tile& tile) { return IsAlike(tile, submap, grid); });
}

bool SubmapSurface::IsSameAs(const SubmapSurface& other) const {
  return std::equal(tiles_.begin(), tiles_.end(), other.tiles_.begin(), other.tiles_.end(),
                    [](const Tile& a, const Tile& b) {
                      return a.index == b.index && a.slot == b.slot && a.around == b.around &&
                             a.box_m.min() == b.box_m.min() && a.box_m.max() == b.box_m.max();
                    });
}

std::vector<std::uint32_t> SubmapSurface::PositionsIn(const SubmapSurface& other) const {
  std::vector<std::uint32_t> positions(tiles_.size(), kElsewhere);
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const Tile* there = other.Find(tiles_[i].index);
    if (there == nullptr || there->slot != tiles_[i].slot) continue;
    positions[i] = static_cast<std::uint32_t>(there - other.tiles_.data());
  }
  return positions;
}

const SubmapSurface::Tile* SubmapSurface::Find(TileIndex tile) const {
  const auto found = std::lower_bound(by_index_.begin(), by_index_.end(), tile,
                                      [this](std::uint32_t i, TileIndex t) { return tiles_[i].index < t; });
  return found != by_index_.end() && tiles_[*found].index == tile ? &tiles_[*found] : nullptr;
}

std::shared_ptr<const TileSurfaceSlot> SubmapSurface::SlotAt(TileIndex tile) const {
  const Tile* found = Find(tile);
  return found != nullptr ? found->slot : nullptr;
}

void SubmapSurface::PrepareUsedSince(std::uint64_t time, const MapSnapshot& state, const Submap& submap,
                                     const std::stop_token& stop) const {
  for (const Tile& tile : tiles_) {
    if (stop.stop_requested()) return;
    if (tile.slot->last_used() >= time) tile.slot->Prepare(state, submap, tile.index);
  }
}

const Eigen::AlignedBox3d& SubmapSurface::BoxOfSurface(const MapSnapshot& state, const Submap& submap) const {
  if (const auto* known = surface_box_.load(std::memory_order_acquire); known != nullptr) return *known;
  auto made = std::make_unique<Eigen::AlignedBox3d>();
  for (std::size_t position = 0; position < tiles_.size(); ++position) {
    const TriangleTree& triangles = Surface(state, submap, position);
    if (triangles.num_triangles() == 0) continue;
    made->extend(FromTile(triangles.bounds().min(), position));
    made->extend(FromTile(triangles.bounds().max(), position));
  }
  const Eigen::AlignedBox3d* there = nullptr;
  if (!surface_box_.compare_exchange_strong(there, made.get(), std::memory_order_acq_rel)) return *there;
  return *made.release();
}

void SubmapSurface::AppendBoxes(const SubmapSurface* other, std::vector<Eigen::AlignedBox3d>& boxes_m) const {
  std::size_t next = 0;
  for (const std::uint32_t position : by_index_) {
    const Tile& tile = tiles_[position];
    if (other != nullptr) {
      const auto there = [&] { return &other->tiles_[other->by_index_[next]]; };
      while (next < other->by_index_.size() && there()->index < tile.index) ++next;
      const bool is_there = next < other->by_index_.size() && there()->index == tile.index;
      if (is_there && there()->slot == tile.slot) continue;
    }
    const TriangleTree* made = tile.slot->IfMade();
    if (made == nullptr) {
      boxes_m.push_back(tile.box_m);
    } else if (made->num_triangles() > 0) {
      boxes_m.emplace_back(tile.corner_m + made->bounds().min().cast<double>(),
                           tile.corner_m + made->bounds().max().cast<double>());
    }
  }
}

}  // namespace dhpmap
