// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/tile_surface_slot.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

std::array<std::weak_ptr<const BlockTile>, 27> TilesOf(const TileNeighbourhood& around) {
  std::array<std::weak_ptr<const BlockTile>, 27> tiles;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (around[i] != nullptr) tiles[i] = around[i]->tile;
  }
  return tiles;
}

/// Of the same object, though it be gone: an address may be used again, what owns it not while a weak pointer is left.
template <typename Object>
bool IsSame(const std::weak_ptr<const Object>& was, const std::shared_ptr<const Object>& is) {
  return !was.owner_before(is) && !is.owner_before(was);
}
bool IsSame(const std::weak_ptr<const BlockTile>& was, const TileEntry* is) {
  static const std::shared_ptr<const BlockTile> kNone;
  return IsSame(was, is == nullptr ? kNone : is->tile);
}

}  // namespace

TileSurfaceSlot::TileSurfaceSlot(const TileNeighbourhood& around, TileIndex tile, double voxel_size_m,
                                 std::shared_ptr<SurfaceLedger> ledger, std::uint64_t last_used)
    : tiles_(TilesOf(around)),
      layers_(LayersOf(FindBlocks(around, tile))),
      voxel_size_m_(voxel_size_m),
      ledger_(std::move(ledger)),
      last_used_(last_used) {}

std::vector<TileSurfaceSlot::Layers> TileSurfaceSlot::LayersOf(const TileBlocks& blocks) {
  std::vector<Layers> layers;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i] != nullptr) layers.push_back({i, blocks[i]->tsdf, blocks[i]->gone});
  }
  layers.shrink_to_fit();
  return layers;
}

TileSurfaceSlot::~TileSurfaceSlot() { ledger_->bytes -= bytes(); }

bool TileSurfaceSlot::IsOf(const TileNeighbourhood& around, TileIndex tile, double voxel_size_m) const {
  if (voxel_size_m != voxel_size_m_) return false;
  const bool are_same_tiles = std::equal(tiles_.begin(), tiles_.end(), around.begin(),
                                         [](const auto& was, const TileEntry* is) { return IsSame(was, is); });
  return are_same_tiles || HasLayersOf(FindBlocks(around, tile));
}

bool TileSurfaceSlot::HasLayersOf(const TileBlocks& blocks) const {
  auto known = layers_.begin();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i] == nullptr) continue;
    if (known == layers_.end() || known->where != i) return false;
    if (!IsSame(known->tsdf, blocks[i]->tsdf) || !IsSame(known->gone, blocks[i]->gone)) return false;
    ++known;
  }
  return known == layers_.end();
}

std::size_t TileSurfaceSlot::bytes() const {
  const TriangleTree* ready = ready_.load(std::memory_order_acquire);
  return ready == nullptr ? 0 : ready->MemoryBytes();
}

const TriangleTree& TileSurfaceSlot::Make(const BlockTable& blocks, TileIndex tile) const {
  const MutexLock lock(mutex_);
  if (made_ == nullptr) {
    made_ = std::make_unique<const TriangleTree>(
        ExtractTileSurface(FindBlocks(FindNeighbourhood(blocks, tile), tile), voxel_size_m_));
    ledger_->bytes += made_->MemoryBytes();
    ready_.store(made_.get(), std::memory_order_release);
  }
  return *made_;
}

}  // namespace dhpmap
