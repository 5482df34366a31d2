// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/tile_surface_slot.h"

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
bool IsSame(const std::weak_ptr<const BlockTile>& was, const TileEntry* is) {
  const std::shared_ptr<const BlockTile> none;
  const std::shared_ptr<const BlockTile>& now = is == nullptr ? none : is->tile;
  return !was.owner_before(now) && !now.owner_before(was);
}

}  // namespace

TileSurfaceSlot::TileSurfaceSlot(const TileNeighbourhood& around, double voxel_size_m,
                                 std::shared_ptr<SurfaceLedger> ledger)
    : tiles_(TilesOf(around)), voxel_size_m_(voxel_size_m), ledger_(std::move(ledger)) {}

TileSurfaceSlot::~TileSurfaceSlot() { ledger_->bytes -= bytes(); }

bool TileSurfaceSlot::IsOf(const TileNeighbourhood& around, double voxel_size_m) const {
  if (voxel_size_m != voxel_size_m_) return false;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    if (!IsSame(tiles_[i], around[i])) return false;
  }
  return true;
}

std::size_t TileSurfaceSlot::bytes() const {
  const TriangleTree* ready = ready_.load(std::memory_order_acquire);
  return ready == nullptr ? 0 : ready->MemoryBytes();
}

const TriangleTree& TileSurfaceSlot::Make(const BlockTable& blocks, TileIndex tile) const {
  const MutexLock lock(mutex_);
  if (made_ == nullptr) {
    made_ =
        std::make_unique<const TriangleTree>(ExtractTileSurface(FindNeighbourhood(blocks, tile), tile, voxel_size_m_));
    ledger_->bytes += made_->MemoryBytes();
    ready_.store(made_.get(), std::memory_order_release);
  }
  return *made_;
}

}  // namespace dhpmap
