// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/nearby_cells.h"

#include <algorithm>

namespace dhpmap {

void NearbyCells::LeaveEarlier() const {
  std::shared_ptr<const Earlier> left;  // destroyed without the mutex
  const MutexLock lock(mutex_);
  has_earlier_.store(false, std::memory_order_relaxed);
  left.swap(earlier_);
}

std::shared_ptr<const NearbyCells::Earlier> NearbyCells::FindEarlier() const {
  if (!has_earlier_.load(std::memory_order_relaxed)) return nullptr;
  const MutexLock lock(mutex_);
  return earlier_;
}

const NearbyCell* NearbyCells::TakeOver(const StateLook& look, Slot& slot, const Eigen::Vector3d& p_map) const {
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
  now->sight = look.sight(BlockAt(p_map));
  const UnseenInside* unseen = then->unseen_inside.load(std::memory_order_acquire);
  if (unseen != nullptr && AreSame(unseen->things, look.things(BlockAt(p_map)))) {
    now->unseen_inside.store(new UnseenInside(*unseen), std::memory_order_relaxed);
  }
  return &Put(slot, std::move(now));
}

const NearbyCell* NearbyCells::FindOrTakeOver(const StateLook& look, const Eigen::Vector3d& p_map) const {
  Slot* const slot = SlotAt(p_map);
  if (slot == nullptr) return nullptr;
  std::uintptr_t num_asked = 0;
  const NearbyCell* cell = Find(*slot, num_asked);
  return cell == nullptr && num_asked == 0 ? TakeOver(look, *slot, p_map) : cell;
}

void NearbyCells::Keep(const Eigen::Vector3d& p_map, std::unique_ptr<const UnseenInside> unseen) const {
  Slot* const slot = SlotAt(p_map);
  std::uintptr_t num_asked = 0;
  const NearbyCell* cell = slot == nullptr ? nullptr : Find(*slot, num_asked);
  if (cell == nullptr) return;
  const std::size_t bytes = unseen->MemoryBytes();
  const UnseenInside* there = nullptr;
  if (!cell->unseen_inside.compare_exchange_strong(there, unseen.get(), std::memory_order_acq_rel)) return;
  (void)unseen.release();
  AddBytes(bytes);
}

}  // namespace dhpmap
