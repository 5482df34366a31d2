// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/vacated_space.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kMostInsideBlocks = 4096;

bool Has(const VoxelMask& mask, int linear) {
  return (mask[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0;
}
void Set(VoxelMask& mask, int linear) {
  mask[static_cast<std::size_t>(linear >> 6)] |= std::uint64_t{1} << (linear & 63);
}

/// What is known of the voxels of one block.
struct Place {
  VoxelMask own{};    ///< the object leaves them
  VoxelMask other{};  ///< they were looked through, or another object shows something there
};

/// A box of voxels, both ends in it.
struct VoxelBox {
  VoxelIndex low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};

  void Extend(VoxelIndex v) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  [[nodiscard]] bool Contains(VoxelIndex v) const {
    return v.x >= low.x && v.x <= high.x && v.y >= low.y && v.y <= high.y && v.z >= low.z && v.z <= high.z;
  }
  [[nodiscard]] bool empty() const { return low.x > high.x; }
  [[nodiscard]] std::int64_t NumBlocks() const {
    const BlockIndex from = BlockOf(low), to = BlockOf(high);
    return (std::int64_t{to.x} - from.x + 1) * (std::int64_t{to.y} - from.y + 1) * (std::int64_t{to.z} - from.z + 1);
  }
};

class Leaving {
 public:
  Leaving(const Submap& submap, const Map& map) : submap_(submap), map_(map) {
    for (const auto& other : map.submaps()) {
      if (other->id() == submap.id() || !IsOnMapGrid(other->info(), map.info().config)) continue;
      const BoundingSphere &a = other->bounding_sphere(), &b = submap.bounding_sphere();
      if ((a.center_m - b.center_m).norm() <= a.radius_m + b.radius_m) others_.push_back(other.get());
    }
  }

  void TakeObserved() {
    const auto half_m = static_cast<float>(0.5 * submap_.info().voxel_size_m);
    for (const BlockEntry& entry : submap_.blocks().entries()) {
      if (entry.tsdf == nullptr) continue;
      Place& place = PlaceAt(entry.index);
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!entry.Shows(i)) continue;
        Set(place.own, i);
        const float distance_m = entry.tsdf->distance_m[static_cast<std::size_t>(i)];
        const VoxelIndex voxel = VoxelIn(entry.index, i);
        if (distance_m <= half_m) surface_.Extend(voxel);
        if (distance_m <= 0) behind_.push_back(voxel);
      }
    }
  }

  void TakeInside() {
    if (surface_.empty() || surface_.NumBlocks() > kMostInsideBlocks) return;
    std::vector<VoxelIndex> reached = std::move(behind_);
    while (!reached.empty()) {
      const VoxelIndex at = reached.back();
      reached.pop_back();
      for (const auto& [dx, dy, dz] : {Step{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
        const VoxelIndex next{at.x + dx, at.y + dy, at.z + dz};
        if (!surface_.Contains(next)) continue;
        Place& place = PlaceAt(BlockOf(next));
        const int i = LinearIndex(next);
        if (Has(place.own, i) || Has(place.other, i)) continue;
        Set(place.own, i);
        reached.push_back(next);
      }
    }
  }

  /// By tile.
  [[nodiscard]] std::map<TileIndex, FreeBlocks> Left() const {
    std::map<TileIndex, FreeBlocks> left;
    for (const auto& [index, place] : places_) {
      VoxelMask mask = place.own;
      for (std::size_t z = 0; z < mask.size(); ++z) mask[z] &= ~place.other[z];
      FreeBlocks& blocks = left[TileOf(index)];
      blocks.mixed |= std::uint64_t{1} << CellOf(index);
      blocks.masks[static_cast<std::size_t>(CellOf(index))] = mask;
    }
    return left;
  }

 private:
  struct Step {
    std::int32_t dx, dy, dz;
  };

  Place& PlaceAt(BlockIndex index) {
    if (last_ != nullptr && index == last_index_) return *last_;
    const auto [found, is_new] = places_.try_emplace(index);
    last_index_ = index;
    last_ = &found->second;
    if (is_new) LookAround(index, *last_);
    return *last_;
  }

  void LookAround(BlockIndex index, Place& place) const {
    const FreeTile* free = map_.free_space().Find(TileOf(index));
    if (free != nullptr) place.other = free->MaskOf(CellOf(index));
    for (const Submap* other : others_) {
      const BlockEntry* there = other->blocks().Find(index);
      if (there == nullptr || there->tsdf == nullptr) continue;
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (there->Shows(i)) Set(place.other, i);
      }
    }
  }

  const Submap& submap_;
  const Map& map_;
  std::vector<const Submap*> others_;  ///< that may lie there
  std::map<BlockIndex, Place> places_;
  BlockIndex last_index_;
  Place* last_ = nullptr;
  VoxelBox surface_;
  std::vector<VoxelIndex> behind_;  ///< its surface, or on it
};

std::int64_t NewestLook_ns(const FreeSpace& space) {
  std::int64_t newest_ns = 0;
  for (const FreeTileEntry& entry : space.tiles()) newest_ns = std::max(newest_ns, entry.tile->last_seen_ns());
  return newest_ns;
}

/// What the object leaves, or would.
std::map<TileIndex, FreeBlocks> LeftBy(const Submap& leaving, const Map& map) {
  const SubmapInfo& info = leaving.info();
  if (info.is_placed || !IsOnMapGrid(info, map.info().config)) return {};
  Leaving places(leaving, map);
  places.TakeObserved();
  if (info.panoptic == Panoptic::kThing) places.TakeInside();
  return places.Left();
}

}  // namespace

void NoteVacated(const Submap& leaving, Map& map) {
  const std::int64_t now_ns = NewestLook_ns(map.free_space());
  for (const auto& [index, blocks] : LeftBy(leaving, map)) map.mutable_vacated().Add(index, blocks, now_ns);
}

void TakeVacatedBack(const Submap& back, Map& map) {
  for (const auto& [index, blocks] : LeftBy(back, map)) {
    const FreeTile* now = map.vacated().Find(index);
    if (now == nullptr) continue;
    auto rest = std::make_shared<FreeTile>(*now);
    rest->Remove(blocks);
    map.mutable_vacated().Erase(index);
    if (!rest->empty()) map.mutable_vacated().Put(index, std::move(rest));
  }
}

}  // namespace dhpmap
