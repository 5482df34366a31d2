// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/outline_cache.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dhpmap {
namespace {

/// A 64-bit hash (splitmix64).
std::uint64_t Mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

std::uint64_t PlaceNumber(TileIndex tile) {
  const auto bits = [](std::int32_t i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
  return Mixed(bits(tile.x) ^ Mixed(bits(tile.y) ^ Mixed(bits(tile.z))));
}

bool IsInMemory(const Submap& submap) {
  const auto tiles = submap.blocks().tiles();
  return std::all_of(tiles.begin(), tiles.end(), [](const TileEntry& tile) { return tile.tile->IsRead(); });
}

}  // namespace

OutlineCache::Key OutlineCache::KeyOf(const Submap& submap) {
  Key key;
  for (const TileEntry& tile : submap.blocks().tiles()) {
    key.tiles += Mixed(tile.tile->part_id() ^ PlaceNumber(tile.index));  // independent of the order
  }
  const Eigen::Vector3d up = 1e9 * submap.info().T_map_submap.linear().row(2).transpose();
  key.up_x = std::llround(up.x());
  key.up_y = std::llround(up.y());
  key.up_z = std::llround(up.z());
  return key;
}

std::optional<SubmapOutline> OutlineCache::Find(const Submap& submap, Reading reading) {
  const Key key = KeyOf(submap);
  const Transform& T_map_submap = submap.info().T_map_submap;
  const Eigen::Matrix3d R_level_submap = LevellingOf(T_map_submap);
  const auto in_map = [&](const std::optional<SubmapOutline>& outline) -> std::optional<SubmapOutline> {
    if (!outline) return std::nullopt;
    return Moved(*outline, T_map_submap * Transform(Eigen::Matrix3d(R_level_submap.transpose())));
  };
  {
    const MutexLock lock(mutex_);
    if (const auto known = by_key_.find(key); known != by_key_.end()) {
      kept_.splice(kept_.begin(), kept_, known->second);
      return in_map(known->second->outline);
    }
  }
  const auto kept = submap.kept_outline().Find(T_map_submap);  // stored with the submap
  if (kept == nullptr && reading == Reading::kNever && !IsInMemory(submap)) return std::nullopt;
  // Without the lock, because computing it twice is harmless.
  Kept found{key, kept != nullptr ? kept->outline : FindOutline(submap, R_level_submap)};
  std::optional<SubmapOutline> answer = in_map(found.outline);
  const MutexLock lock(mutex_);
  if (by_key_.contains(key)) return answer;
  kept_.push_front(std::move(found));
  by_key_.emplace(key, kept_.begin());
  if (kept_.size() > most_) {
    by_key_.erase(kept_.back().key);
    kept_.pop_back();
  }
  return answer;
}

std::size_t OutlineCache::size() const {
  const MutexLock lock(mutex_);
  return kept_.size();
}

}  // namespace dhpmap
