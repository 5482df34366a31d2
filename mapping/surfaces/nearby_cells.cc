// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/nearby_cells.h"

#include <algorithm>

namespace dhpmap {

void NearbyCells::LeaveEarlier() const {
  std::shared_ptr<const Earlier> left;  // goes without the mutex
  const MutexLock lock(mutex_);
  has_earlier_.store(false, std::memory_order_relaxed);
  left.swap(earlier_);
}

std::shared_ptr<const NearbyCells::Earlier> NearbyCells::FindEarlier() const {
  if (!has_earlier_.load(std::memory_order_relaxed)) return nullptr;
  const MutexLock lock(mutex_);
  return earlier_;
}

const NearbyCell* NearbyCells::TakeOver(const SightOf& sight_of, Slot& slot, const Eigen::Vector3d& p_map) const {
  const std::shared_ptr<const Earlier> earlier = FindEarlier();
  if (earlier == nullptr) return nullptr;
  Slot* const slot_then = earlier->cells->SlotAt(p_map);
  std::uintptr_t num_asked = 0;
  const NearbyCell* then = slot_then == nullptr ? nullptr : earlier->cells->Find(*slot_then, num_asked);
  if (then == nullptr) return nullptr;
  const auto is_near = [then](const Eigen::AlignedBox3d& box_m) {
    constexpr double kRounding = 1 + 1e-5;
    return box_m.exteriorDistance(then->centre_m) <= kRounding * static_cast<double>(then->complete_m);
  };
  if (std::any_of(earlier->new_m.begin(), earlier->new_m.end(), is_near)) return nullptr;
  auto now = std::make_unique<NearbyCell>();
  now->centre_m = then->centre_m;
  now->complete_m = then->complete_m;
  now->tiles = then->tiles;
  for (NearbyTile& tile : now->tiles) {
    const Earlier::Part& part = earlier->parts[tile.number];
    tile.number = part.number;
    if (part.number == Earlier::kGone || part.is_same) continue;
    tile.tile = part.tiles[tile.tile];
    if (tile.tile == Earlier::kGone) tile.number = Earlier::kGone;
  }
  const auto is_gone = [](const NearbyTile& tile) { return tile.number == Earlier::kGone; };
  if (std::any_of(now->tiles.begin(), now->tiles.end(), is_gone)) return nullptr;
  now->sight = sight_of(BlockAt(p_map));
  return &Put(slot, std::move(now));
}

}  // namespace dhpmap
