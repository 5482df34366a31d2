// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/left_space.h"

#include <algorithm>
#include <bit>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/base/status_error.h"
#include "mapping/map/map_grid.h"
#include "mapping/voxels/shown_mask.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kMostInsideBlocks = 4096;

/// State of one block's voxels.
struct Place {
  VoxelMask own{};      ///< the object shows them
  VoxelMask other{};    ///< looked through, or surface of another object
  VoxelMask reached{};  ///< behind its surface, or reached from there
};

// Words of a mask: bit x + 8 y.
constexpr std::uint64_t kFirstX = 0x0101010101010101u, kLastX = kFirstX << 7;
constexpr std::uint64_t kFirstRow = 0xFF;
constexpr int kRow_bits = kBlockSide, kToLastRow_bits = kBlockSide * (kBlockSide - 1);

/// Marks the voxels of `may` that are reached from marked ones, from neighbour to neighbour within the block.
void SpreadWithin(const VoxelMask& may, VoxelMask& reached) {
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (std::size_t z = 0; z < reached.size(); ++z) {
      const std::uint64_t word = reached[z];
      std::uint64_t beside = (word & ~kLastX) << 1 | (word & ~kFirstX) >> 1 | word << kRow_bits | word >> kRow_bits;
      if (z > 0) beside |= reached[z - 1];
      if (z + 1 < reached.size()) beside |= reached[z + 1];
      const std::uint64_t next = word | (beside & may[z]);
      is_new = is_new || next != word;
      reached[z] = next;
    }
  }
}

struct BlockStep {
  std::int32_t dx, dy, dz;
};
constexpr BlockStep kSteps[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/// The voxels of the next block in that direction that are adjacent to the mask.
VoxelMask Across(const VoxelMask& mask, const BlockStep& step) {
  VoxelMask next{};
  if (step.dz > 0) next.front() = mask.back();
  if (step.dz < 0) next.back() = mask.front();
  if (step.dz != 0) return next;
  for (std::size_t z = 0; z < mask.size(); ++z) {
    if (step.dx > 0) next[z] = (mask[z] & kLastX) >> (kBlockSide - 1);
    if (step.dx < 0) next[z] = (mask[z] & kFirstX) << (kBlockSide - 1);
    if (step.dy > 0) next[z] = mask[z] >> kToLastRow_bits;
    if (step.dy < 0) next[z] = mask[z] << kToLastRow_bits;
  }
  return next;
}

VoxelMask Both(const VoxelMask& a, const VoxelMask& b) {
  VoxelMask both{};
  for (std::size_t z = 0; z < both.size(); ++z) both[z] = a[z] & b[z];
  return both;
}

/// The difference a \ b.
VoxelMask Without(const VoxelMask& a, const VoxelMask& b) {
  VoxelMask rest{};
  for (std::size_t z = 0; z < rest.size(); ++z) rest[z] = a[z] & ~b[z];
  return rest;
}

void AddTo(VoxelMask& mask, const VoxelMask& more) {
  for (std::size_t z = 0; z < mask.size(); ++z) mask[z] |= more[z];
}

/// A box of voxels, both ends included.
struct VoxelBox {
  VoxelIndex low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};

  /// Grows to include the block's voxels in the mask.
  void Extend(BlockIndex index, const VoxelMask& mask) {
    std::uint64_t slices = 0, rows = 0, row = 0;
    for (std::size_t z = 0; z < mask.size(); ++z) {
      rows |= mask[z];
      slices |= std::uint64_t{mask[z] != 0} << z;
    }
    if (rows == 0) return;
    for (int y = 0; y < kBlockSide; ++y) row |= rows >> (y * kRow_bits) & kFirstRow;
    const VoxelIndex first = VoxelIn(index, 0);
    const auto extend = [](std::int32_t& least, std::int32_t& most, std::int32_t from, std::uint64_t bits) {
      least = std::min(least, from + std::countr_zero(bits));
      most = std::max(most, from + HighestOf(bits));
    };
    extend(low.x, high.x, first.x, row);
    low.y = std::min(low.y, first.y + std::countr_zero(rows) / kRow_bits);
    high.y = std::max(high.y, first.y + HighestOf(rows) / kRow_bits);
    extend(low.z, high.z, first.z, slices);
  }
  /// The block's voxels in the box.
  [[nodiscard]] VoxelMask In(BlockIndex index) const {
    const VoxelIndex first = VoxelIn(index, 0);
    const std::uint64_t row = Bits(low.x - first.x, high.x - first.x), rows = Bits(low.y - first.y, high.y - first.y);
    const std::uint64_t slices = Bits(low.z - first.z, high.z - first.z);
    std::uint64_t slice = 0;
    for (int y = 0; y < kBlockSide; ++y) {
      if ((rows >> y & 1u) != 0) slice |= row << (y * kRow_bits);
    }
    VoxelMask mask{};
    for (std::size_t z = 0; z < mask.size(); ++z) mask[z] = (slices >> z & 1u) != 0 ? slice : 0;
    return mask;
  }
  [[nodiscard]] bool empty() const { return low.x > high.x; }
  /// Whether the box contains the whole block.
  [[nodiscard]] bool Holds(BlockIndex index) const {
    const VoxelIndex first = VoxelIn(index, 0), last = VoxelIn(index, kBlockVoxels - 1);
    return low.x <= first.x && low.y <= first.y && low.z <= first.z && last.x <= high.x && last.y <= high.y &&
           last.z <= high.z;
  }
  [[nodiscard]] std::int64_t NumBlocks() const {
    const BlockIndex from = BlockOf(low), to = BlockOf(high);
    return (std::int64_t{to.x} - from.x + 1) * (std::int64_t{to.y} - from.y + 1) * (std::int64_t{to.z} - from.z + 1);
  }

 private:
  /// Requires `bits` != 0.
  static int HighestOf(std::uint64_t bits) { return 63 - std::countl_zero(bits); }
  /// Bits `from` to `to` of eight, both included.
  static std::uint64_t Bits(std::int32_t from, std::int32_t to) {
    std::uint64_t bits = 0;
    for (int i = std::max(from, 0); i <= std::min(to, kBlockSide - 1); ++i) bits |= std::uint64_t{1} << i;
    return bits;
  }
};

class Leaving {
 public:
  explicit Leaving(const MovedAway& state) : submap_(state.moved), free_space_(state.free_space) {
    for (const auto& other : state.submaps) {
      if (other->id() == submap_.id() || !IsOnMapGrid(other->info(), state.config)) continue;
      const BoundingSphere &a = other->bounding_sphere(), &b = submap_.bounding_sphere();
      if ((a.center_m - b.center_m).norm() <= a.radius_m + b.radius_m) others_.push_back(other.get());
    }
  }

  /// Calls visit(TileIndex, FreeBlocks) for each tile, in order.
  template <typename Visitor>
  void VisitLeft(Visitor&& visit) {
    const bool has_inside = submap_.info().panoptic == Panoptic::kThing && FindSurface();
    if (!has_inside) return VisitShown(visit);
    TakeObserved();
    TakeInside();
    for (const auto& [index, blocks] : Left()) visit(index, blocks);
  }

 private:
  /// Finds the box of voxels within half a voxel of the surface, or behind it. Returns false if there is none, or if it
  /// is too large for an inside; nothing more of it is read then.
  bool FindSurface() {
    const auto half_m = static_cast<float>(0.5 * submap_.info().voxel_size_m);
    for (const BlockEntry& entry : submap_.blocks().entries()) {
      if (entry.tsdf == nullptr || surface_.Holds(entry.index)) continue;
      const VoxelMask near = MaskWhere(entry.tsdf->distance_m, [half_m](float d) { return d <= half_m; });
      surface_.Extend(entry.index, Both(near, ShownMask(entry)));
      if (!surface_.empty() && surface_.NumBlocks() > kMostInsideBlocks) return false;
    }
    return !surface_.empty();
  }

  /// Visits the voxels that the object shows, tile by tile.
  template <typename Visitor>
  void VisitShown(Visitor&& visit) const {
    std::vector<const TileEntry*> tiles;
    for (const TileEntry& tile : submap_.blocks().tiles()) tiles.push_back(&tile);
    std::sort(tiles.begin(), tiles.end(), [](const auto* a, const auto* b) { return a->index < b->index; });
    FreeBlocks left;
    for (const TileEntry* tile : tiles) {
      left.mixed = 0;
      for (const BlockEntry& entry : tile->tile->entries()) {
        if (entry.tsdf == nullptr) continue;
        left.mixed |= std::uint64_t{1} << CellOf(entry.index);
        left.masks[static_cast<std::size_t>(CellOf(entry.index))] =
            Without(ShownMask(entry), ShownByOthers(entry.index));
      }
      if (left.mixed != 0) visit(tile->index, left);
    }
  }

  void TakeObserved() {
    for (const BlockEntry& entry : submap_.blocks().entries()) {
      if (entry.tsdf == nullptr) continue;
      Place& place = PlaceAt(entry.index);
      place.own = ShownMask(entry);
      AddTo(place.reached, Both(place.own, MaskWhere(entry.tsdf->distance_m, [](float d) { return d <= 0; })));
      if (!HasNone(place.reached)) open_.push_back(entry.index);
    }
  }

  /// Works by blocks and whole rows: the result does not depend on the order.
  void TakeInside() {
    while (!open_.empty()) {
      const BlockIndex at = open_.back();
      open_.pop_back();
      Place& place = PlaceAt(at);
      SpreadWithin(Inside(at, place), place.reached);
      for (const BlockStep& step : kSteps)
        Enter({at.x + step.dx, at.y + step.dy, at.z + step.dz}, Across(place.reached, step));
    }
    for (auto& [index, place] : places_) AddTo(place.own, place.reached);
  }

  /// The vacated voxels by tile.
  [[nodiscard]] std::map<TileIndex, FreeBlocks> Left() const {
    std::map<TileIndex, FreeBlocks> left;
    for (const auto& [index, place] : places_) {
      FreeBlocks& blocks = left[TileOf(index)];
      blocks.mixed |= std::uint64_t{1} << CellOf(index);
      blocks.masks[static_cast<std::size_t>(CellOf(index))] = Without(place.own, place.other);
    }
    return left;
  }

  /// The voxels of a block that may be inside: unseen, and in the box around the surface.
  [[nodiscard]] VoxelMask Inside(BlockIndex index, const Place& place) const {
    return Without(Without(surface_.In(index), place.own), place.other);
  }

  /// Marks voxels reached from a neighbouring block.
  void Enter(BlockIndex index, const VoxelMask& from_beside) {
    if (HasNone(Both(from_beside, surface_.In(index)))) return;
    Place& place = PlaceAt(index);
    const VoxelMask entered = Both(from_beside, Inside(index, place));
    bool is_new = false;
    for (std::size_t z = 0; z < entered.size(); ++z) {
      is_new = is_new || (entered[z] & ~place.reached[z]) != 0;
      place.reached[z] |= entered[z];
    }
    if (is_new) open_.push_back(index);
  }

  Place& PlaceAt(BlockIndex index) {
    if (last_ != nullptr && index == last_index_) return *last_;
    last_index_ = index;
    const std::uint32_t known = numbers_.Find(index);
    if (known != IndexMap<BlockIndex>::kNone) {
      last_ = &places_[known].second;
      return *last_;
    }
    numbers_.Set(index, static_cast<std::uint32_t>(places_.size()));
    last_ = &places_.emplace_back(index, Place{}).second;
    last_->other = ShownByOthers(index);
    return *last_;
  }

  /// Voxels that other objects show, or that sensors looked through.
  [[nodiscard]] VoxelMask ShownByOthers(BlockIndex index) const {
    const FreeTile* free = free_space_.Find(TileOf(index));
    VoxelMask shown = free != nullptr ? free->MaskOf(CellOf(index)) : VoxelMask{};
    for (const Submap* other : others_) {
      const BlockEntry* there = other->blocks().Find(index);
      if (there != nullptr && there->tsdf != nullptr) AddTo(shown, ShownMask(*there));
    }
    return shown;
  }

  const Submap& submap_;
  const FreeSpace& free_space_;
  std::vector<const Submap*> others_;                ///< objects that may overlap
  std::deque<std::pair<BlockIndex, Place>> places_;  ///< a deque, so that adding moves none
  IndexMap<BlockIndex> numbers_;                     ///< position in places_
  BlockIndex last_index_;
  Place* last_ = nullptr;
  VoxelBox surface_;
  std::vector<BlockIndex> open_;  ///< blocks with newly reached voxels
};

std::int64_t NewestLook_ns(const FreeSpace& space) {
  std::int64_t newest_ns = 0;
  for (const FreeTileEntry& entry : space.tiles()) newest_ns = std::max(newest_ns, entry.tile->last_seen_ns());
  return newest_ns;
}

}  // namespace

void AddLeft(const MovedAway& state, FreeSpace& vacated) {
  const std::int64_t now_ns = NewestLook_ns(state.free_space);
  Leaving(state).VisitLeft([&](TileIndex index, const FreeBlocks& left) { vacated.Add(index, left, now_ns); });
}

std::shared_ptr<const FreeSpace> WithLeft(const MovedAway& state, const std::shared_ptr<const FreeSpace>& vacated) {
  auto with_left = std::make_shared<FreeSpace>(*vacated);
  with_left->ShareTiles();
  with_left->set_generation(vacated->generation() + 1);  // else tiles of generation 0 would be written in place
  try {
    AddLeft(state, *with_left);
  } catch (const StatusError&) {
    return vacated;
  }
  with_left->ShareTiles();
  with_left->set_generation(vacated->generation());
  return with_left;
}

void TakeLeft(const MovedAway& state, FreeSpace& vacated) {
  Leaving(state).VisitLeft([&vacated](TileIndex index, const FreeBlocks& left) {
    const FreeTile* now = vacated.Find(index);
    if (now == nullptr) return;
    auto rest = std::make_shared<FreeTile>(*now);
    rest->Remove(left);
    vacated.Erase(index);
    if (!rest->empty()) vacated.Put(index, std::move(rest));
  });
}

}  // namespace dhpmap
