// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/tile_surface_slot.h"

#include <algorithm>
#include <utility>

#include "mapping/base/this_thread.h"

namespace dhpmap {
namespace {

/// All tiles in and around a tile, with their submaps.
std::vector<std::uint64_t> TilesOf(const TilePlace& place) {
  std::vector<std::uint64_t> tiles;
  tiles.reserve((place.around.size() + 1) * (1 + place.sharers.size()));
  const auto append = [&tiles](const TileNeighbourhood& around) {
    for (const TileEntry* entry : around) tiles.push_back(entry == nullptr ? 0 : entry->tile->part_id());
  };
  append(place.around);
  if (!place.sharers.empty()) tiles.push_back(place.owner.value);
  for (const TilePlace::Sharer& sharer : place.sharers) {
    tiles.push_back(sharer.id.value);
    append(sharer.around);
  }
  return tiles;
}

}  // namespace

TileSurfaceSlot::TileSurfaceSlot(const TilePlace& place, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger,
                                 std::uint64_t last_used)
    : tiles_(TilesOf(place)),
      layers_(LayersOf(place)),
      voxel_size_m_(voxel_size_m),
      ledger_(std::move(ledger)),
      last_used_(last_used) {}

std::vector<TileSurfaceSlot::Layers> TileSurfaceSlot::LayersOf(const TilePlace& place) {
  std::vector<Layers> layers;
  TilePlaces own;
  const auto append = [&](const TileNames& names, const TilePlaces& wanted, SubmapId owner, bool is_shared) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].tsdf == 0 || !wanted[i]) continue;
      if (!is_shared) own.set(i);
      layers.push_back({owner, is_shared, static_cast<std::uint8_t>(i), names[i].tsdf, names[i].gone});
    }
  };
  append(FindNames(place.around, place.tile), TilePlaces().set(), SubmapId(0), false);
  const std::size_t num_own = layers.size();
  const TilePlaces beside = Widened(own);
  for (const TilePlace::Sharer& sharer : place.sharers) {
    append(FindNames(sharer.around, place.tile), beside, sharer.id, true);
  }
  // The owner of a shared cell depends on the owners of its voxels.
  if (layers.size() > num_own && num_own > 0) layers[0].owner = place.owner;
  layers.shrink_to_fit();
  return layers;
}

TileSurfaceSlot::~TileSurfaceSlot() {
  ledger_->bytes -= bytes();
  delete ready_.load();
}

bool TileSurfaceSlot::IsOf(const TilePlace& place, double voxel_size_m) const {
  if (voxel_size_m != voxel_size_m_) return false;
  return TilesOf(place) == tiles_ || LayersOf(place) == layers_;
}

std::size_t TileSurfaceSlot::bytes() const {
  const TriangleTree* ready = ready_.load(std::memory_order_acquire);
  return ready == nullptr ? 0 : ready->MemoryBytes();
}

const TriangleTree& TileSurfaceSlot::MakeInTurn(const MapSnapshot& state, const Submap& submap, TileIndex tile) const {
  const MutexLock lock(IsThisThreadNicer() ? nice_makers_ : makers_);
  const TriangleTree* ready = ready_.load(std::memory_order_acquire);
  return ready != nullptr ? *ready : Make(state, submap, tile);
}

const TriangleTree& TileSurfaceSlot::Make(const MapSnapshot& state, const Submap& submap, TileIndex tile) const {
  const TileOwner own{submap.id(), FindBlocks(FindNeighbourhood(submap.blocks(), tile), tile)};
  std::vector<TileOwner> sharers;
  const Submap* sharer = nullptr;
  const BlockIndex first = BlockIn(tile, 0);
  for (const Layers& layer : layers_) {
    if (!layer.is_shared) continue;
    if (sharer == nullptr || sharer->id() != layer.owner) {
      sharer = state.Find(layer.owner);
      sharers.push_back({layer.owner, {}});
    }
    const BlockIndex offset = OffsetInTile(layer.where);
    sharers.back().blocks[layer.where] =
        sharer->blocks().Find({first.x + offset.x, first.y + offset.y, first.z + offset.z});
  }
  auto made = std::make_unique<const TriangleTree>(ExtractTileSurface(own, sharers, voxel_size_m_));
  const TriangleTree* there = nullptr;
  if (!ready_.compare_exchange_strong(there, made.get(), std::memory_order_acq_rel)) return *there;
  ledger_->bytes += made->MemoryBytes();
  return *made.release();
}

}  // namespace dhpmap
