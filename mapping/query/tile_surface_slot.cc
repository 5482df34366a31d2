// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/tile_surface_slot.h"

#include <algorithm>
#include <utility>

#include "mapping/base/this_thread.h"

namespace dhpmap {
namespace {

std::array<std::uint64_t, 27> TilesOf(const TileNeighbourhood& around) {
  std::array<std::uint64_t, 27> tiles{};
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (around[i] != nullptr) tiles[i] = around[i]->tile->part_id();
  }
  return tiles;
}

}  // namespace

TileSurfaceSlot::TileSurfaceSlot(const TileNeighbourhood& around, TileIndex tile, double voxel_size_m,
                                 std::shared_ptr<SurfaceLedger> ledger, std::uint64_t last_used)
    : tiles_(TilesOf(around)),
      layers_(LayersOf(FindNames(around, tile))),
      voxel_size_m_(voxel_size_m),
      ledger_(std::move(ledger)),
      last_used_(last_used) {}

std::vector<TileSurfaceSlot::Layers> TileSurfaceSlot::LayersOf(const TileNames& names) {
  std::vector<Layers> layers;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].tsdf != 0) layers.push_back({i, names[i]});
  }
  layers.shrink_to_fit();
  return layers;
}

TileSurfaceSlot::~TileSurfaceSlot() {
  ledger_->bytes -= bytes();
  delete ready_.load();
}

bool TileSurfaceSlot::IsOf(const TileNeighbourhood& around, TileIndex tile, double voxel_size_m) const {
  if (voxel_size_m != voxel_size_m_) return false;
  return TilesOf(around) == tiles_ || HasLayersOf(FindNames(around, tile));
}

bool TileSurfaceSlot::HasLayersOf(const TileNames& names) const {
  auto known = layers_.begin();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].tsdf == 0) continue;
    if (known == layers_.end() || known->where != i) return false;
    if (known->names.tsdf != names[i].tsdf || known->names.gone != names[i].gone) return false;
    ++known;
  }
  return known == layers_.end();
}

std::size_t TileSurfaceSlot::bytes() const {
  const TriangleTree* ready = ready_.load(std::memory_order_acquire);
  return ready == nullptr ? 0 : ready->MemoryBytes();
}

const TriangleTree& TileSurfaceSlot::MakeInTurn(const BlockTable& blocks, TileIndex tile) const {
  const MutexLock lock(IsThisThreadNicer() ? nice_makers_ : makers_);
  const TriangleTree* ready = ready_.load(std::memory_order_acquire);
  return ready != nullptr ? *ready : Make(blocks, tile);
}

const TriangleTree& TileSurfaceSlot::Make(const BlockTable& blocks, TileIndex tile) const {
  auto made = std::make_unique<const TriangleTree>(
      ExtractTileSurface(FindBlocks(FindNeighbourhood(blocks, tile), tile), voxel_size_m_));
  const TriangleTree* there = nullptr;
  if (!ready_.compare_exchange_strong(there, made.get(), std::memory_order_acq_rel)) return *there;
  ledger_->bytes += made->MemoryBytes();
  return *made.release();
}

}  // namespace dhpmap
