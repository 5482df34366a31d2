// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/query_world.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <utility>

#include "mapping/query/voxel_sampler.h"
#include "mapping/surfaces/thing_inside.h"

namespace dhpmap {
namespace {

/// The oldest stamp within `max_age_s` of the newest one.
std::int64_t OldestOf(const FreeSpace& space, double max_age_s) {
  std::int64_t newest_ns = std::numeric_limits<std::int64_t>::min();
  for (const FreeTileEntry& tile : space.tiles()) newest_ns = std::max(newest_ns, tile.tile->last_seen_ns());
  const double oldest_ns = static_cast<double>(newest_ns) - 1e9 * max_age_s;
  constexpr double kLeast_ns = -9.2e18;
  return oldest_ns > kLeast_ns ? newest_ns - static_cast<std::int64_t>(1e9 * max_age_s)
                               : std::numeric_limits<std::int64_t>::min();
}

/// Restricts `is_there` (empty: all of `entries`) to submaps that may not be touched.
std::vector<bool> WithoutTouchable(std::vector<bool> is_there, std::vector<SubmapId> may_touch,
                                   std::span<const SubmapIndex::Entry> entries) {
  if (is_there.empty()) is_there.assign(entries.size(), true);
  std::sort(may_touch.begin(), may_touch.end());
  for (std::size_t number = 0; number < entries.size(); ++number) {
    if (std::binary_search(may_touch.begin(), may_touch.end(), entries[number].submap().id())) is_there[number] = false;
  }
  return is_there;
}

}  // namespace

QueryWorld::QueryWorld(std::shared_ptr<const MapSurfaces> surfaces, const QueryScope& scope)
    : surfaces_(std::move(surfaces)), free_space_(surfaces_->state().free_space().get()) {
  if (scope.max_free_age_s) oldest_ns_ = OldestOf(*free_space_, *scope.max_free_age_s);
  const std::span<const SubmapIndex::Entry> entries = surfaces_->index().entries();
  if (!scope.IsAll()) {
    for (const SubmapIndex::Entry& entry : entries) is_held_.push_back(scope.Holds(entry.submap().info()));
  }
  if (!scope.may_touch.empty()) in_the_way_ = WithoutTouchable(is_held_, scope.may_touch, entries);
  if (scope.vacated_is_free) with_vacated_ = WithVacated();
  takes_all_ = scope.IsAll() && in_the_way_.empty() && !scope.max_free_age_s && with_vacated_.empty();
  const auto is_attached = [&](const SubmapIndex::Entry& entry) {
    return std::find(scope.attached.begin(), scope.attached.end(), entry.submap().id()) != scope.attached.end();
  };
  if (!is_held_.empty() && (scope.vacated_is_free || !scope.attached.empty())) {
    for (std::size_t number = 0; number < entries.size(); ++number) {
      is_attached_.push_back(is_attached(entries[number]));
      has_left_.push_back(is_attached_[number] ? !scope.keeps_attached_unknown
                                               : scope.vacated_is_free && !is_held_[number]);
    }
    if (std::find(has_left_.begin(), has_left_.end(), true) == has_left_.end()) has_left_.clear();
  }
  if (scope.padding.classes.empty() && scope.padding.submaps.empty()) {
    grown_.push_back({scope.padding.default_m, in_the_way_.empty() ? is_held_ : in_the_way_});
    return;
  }
  std::map<double, std::vector<bool>, std::greater<>> by_padding = {
      {scope.padding.default_m, std::vector<bool>(entries.size())}};
  for (std::size_t number = 0; number < entries.size(); ++number) {
    if (!IsInTheWay(number)) continue;
    auto& is_held = by_padding[scope.padding.Of(entries[number].submap().info())];
    is_held.resize(entries.size());
    is_held[number] = true;
  }
  for (auto& [padding_m, is_held] : by_padding) grown_.push_back({padding_m, std::move(is_held)});
}

FreeSpace QueryWorld::WithVacated() const {
  const auto add = [](const FreeTile& tile, TileIndex index, FreeSpace& sum) {
    FreeBlocks blocks{.full = tile.full(), .mixed = tile.mixed()};
    for (std::uint64_t cells = blocks.mixed; cells != 0; cells &= cells - 1) {
      const int cell = std::countr_zero(cells);
      blocks.masks[static_cast<std::size_t>(cell)] = tile.MaskOf(cell);
    }
    sum.Add(index, blocks, tile.last_seen_ns());
  };
  FreeSpace sum;
  for (const FreeTileEntry& entry : surfaces_->state().vacated()->tiles()) {
    if (entry.tile->last_seen_ns() < oldest_ns_) continue;
    add(*entry.tile, entry.index, sum);
    if (const FreeTile* seen = FindLookedThrough(entry.index); seen != nullptr) add(*seen, entry.index, sum);
  }
  return sum;
}

bool QueryWorld::IsObserved(VoxelIndex voxel) const {
  const Eigen::Vector3d centre = VoxelCentre(voxel, voxel_size_m());
  const SubmapIndex& index = surfaces_->index();
  bool is_observed = false;
  index.VisitAround(centre, [&](const SubmapIndex::Entry& entry) {
    if (is_observed || !Holds(static_cast<std::size_t>(&entry - index.entries().data()))) return;
    is_observed = SampleVoxelAt(entry.submap(), entry.ToSubmap(centre)).IsObserved();
  });
  return is_observed || IsLeft(centre);
}

bool QueryWorld::IsInTouchable(VoxelIndex voxel, double max_depth_m) const {
  if (!has_touchable()) return false;
  const NearestSurface nearest =
      NearestSearch(*surfaces_, is_held_, is_held_).Find(VoxelCentre(voxel, voxel_size_m()), max_depth_m);
  return nearest.is_any && !in_the_way_[nearest.number] && nearest.is_behind && !nearest.is_beside;
}

bool QueryWorld::HasLeft(std::size_t number, const Eigen::Vector3d& p_map) const {
  const std::span<const SubmapIndex::Entry> entries = surfaces_->index().entries();
  const SubmapIndex::Entry& entry = entries[number];
  const Eigen::Vector3d p_submap = entry.ToSubmap(p_map);
  if (!entry.box_m().contains(p_submap)) return false;
  if (SampleVoxelAt(entry.submap(), p_submap).IsObserved()) return true;
  if (entry.submap().info().panoptic != Panoptic::kThing && !is_attached_[number]) return false;
  std::vector<bool> is_held(entries.size());
  is_held[number] = true;
  const NearestSurface nearest = NearestSearch(*surfaces_, is_held).Find(p_map, entry.box_m().diagonal().norm());
  return nearest.is_any && nearest.is_behind;
}

bool QueryWorld::IsLeft(const Eigen::Vector3d& p_map) const {
  if (has_left_.empty()) return false;
  bool is_left = false;
  const SubmapIndex& index = surfaces_->index();
  index.tree().VisitOverlapping({index.InTree(p_map), index.InTree(p_map)}, [&](std::size_t position) {
    const std::size_t number = index.tree().items()[position];
    is_left = has_left_[number] && HasLeft(number, p_map);
    return !is_left;
  });
  return is_left;
}

FreeMask QueryWorld::LeftVoxels(BlockIndex block) const {
  FreeMask left{};
  if (has_left_.empty()) return left;
  const SubmapIndex& index = surfaces_->index();
  const Eigen::Vector3d corner = BlockCorner(block, voxel_size_m());
  const Eigen::Vector3d end = corner + Eigen::Vector3d::Constant(kBlockSide * voxel_size_m());
  bool may_be_left = false;
  index.tree().VisitOverlapping({index.InTree(corner), index.InTree(end)}, [&](std::size_t position) {
    may_be_left = has_left_[index.tree().items()[position]];
    return !may_be_left;
  });
  for (int i = 0; i < kBlockVoxels && may_be_left; ++i) {
    if (!IsLeft(VoxelCentre(VoxelIn(block, i), voxel_size_m()))) continue;
    left[static_cast<std::size_t>(i >> 6)] |= std::uint64_t{1} << (i & 63);
  }
  return left;
}

bool QueryWorld::IsInsideThing(const Eigen::Vector3d& p_map, bool is_across) const {
  bool is_inside = false;
  surfaces_->VisitThings({p_map, p_map}, [&](const MapSurfaces::Thing& thing) {
    is_inside = IsInTheWay(thing.number) && IsInside(thing.number, p_map, is_across);
    return !is_inside;
  });
  return is_inside;
}

bool QueryWorld::IsInside(std::uint32_t number, const Eigen::Vector3d& p_map, bool is_across) const {
  const SubmapIndex::Entry& entry = surfaces_->index().entries()[number];
  const Eigen::Vector3d p_submap = entry.ToSubmap(p_map);
  const Eigen::AlignedBox3d& surface_m = surfaces_->surface(number).BoxOfSurface(surfaces_->state(), entry.submap());
  const bool is_in_box = surface_m.contains(p_submap);
  if (!is_in_box && (is_across || !AsDeepAsWide(surface_m).contains(p_submap))) return false;
  const double limit_m = 3 * surface_m.diagonal().norm();
  const NearestSurface own = NearestSearch(*surfaces_, is_held_, is_held_).FindOf(number, p_map, limit_m);
  if (!own.is_any || !own.is_behind) return false;
  return is_in_box || !IsStraightInFront(p_map, limit_m);
}

bool QueryWorld::IsStraightInFront(const Eigen::Vector3d& p_map, double limit_m) const {
  NearestSearch search(*surfaces_, is_held_, is_held_);
  search.TellWhereInFrontToo();
  const NearestSurface nearest = search.Find(p_map, limit_m);
  return nearest.is_any && !nearest.is_behind && !nearest.is_beside;
}

bool QueryWorld::IsSeenAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const {
  const int linear = LinearIndex(VoxelAt(p_map, voxel_size_m()));
  if (nearest.sight != nullptr && takes_all_) {
    if (CellSight::Has(nearest.sight->free, linear) || CellSight::Has(nearest.sight->observed, linear)) return true;
    return !nearest.sight->others.empty() && SightIn(*nearest.sight, p_map).is_seen;
  }
  return IsFree(VoxelAt(p_map, voxel_size_m())) || SightAt(p_map, nearest).is_seen;
}

QueryWorld::Sight QueryWorld::SightIn(const CellSight& cell, const Eigen::Vector3d& p_map) const {
  const int linear = LinearIndex(VoxelAt(p_map, voxel_size_m()));
  Sight sight{.is_seen = CellSight::Has(cell.observed, linear), .is_front = CellSight::Has(cell.front, linear)};
  for (const std::uint32_t number : cell.others) {
    if (sight.is_front) break;
    const SubmapIndex::Entry& entry = surfaces_->index().entries()[number];
    const Eigen::Vector3d p_submap = entry.ToSubmap(p_map);
    if (!entry.MayHold(p_submap)) continue;
    const VoxelSample voxel = SampleVoxelAt(entry.submap(), p_submap);
    if (!voxel.IsObserved()) continue;
    sight.is_seen = true;
    sight.is_front |= voxel.distance_m() > 0;
  }
  if (!sight.is_seen && CellSight::Has(cell.free, linear)) sight = {.is_seen = true, .is_front = true};
  return sight;
}

QueryWorld::Sight QueryWorld::SightAt(const Eigen::Vector3d& p_map, const NearestSurface& nearest) const {
  if (nearest.sight != nullptr && takes_all_) return SightIn(*nearest.sight, p_map);
  Sight sight;
  const std::span<const SubmapIndex::Entry> entries = surfaces_->index().entries();
  const auto look = [&sight](const Submap& submap, const Eigen::Vector3d& p_submap, bool is_in_the_way) {
    const VoxelSample voxel = SampleVoxelAt(submap, p_submap);
    if (!voxel.IsObserved()) return;
    const bool is_front = voxel.distance_m() > 0;
    sight.is_seen |= is_front || is_in_the_way;
    sight.is_front |= is_front;
  };
  if (nearest.is_any && entries[nearest.number].MayHold(nearest.p_submap)) {
    look(entries[nearest.number].submap(), nearest.p_submap, true);
    if (sight.is_front || (sight.is_seen && !nearest.is_behind)) return sight;
  }
  surfaces_->index().VisitAround(p_map, [&](const SubmapIndex::Entry& entry) {
    const auto number = static_cast<std::size_t>(&entry - entries.data());
    if (!sight.is_front && Holds(number)) look(entry.submap(), entry.ToSubmap(p_map), IsInTheWay(number));
  });
  // A voxel next to a surface may have been looked through as well: data of submaps take precedence.
  if (!sight.is_seen && (IsFree(VoxelAt(p_map, voxel_size_m())) || IsLeft(p_map)))
    sight = {.is_seen = true, .is_front = true};
  return sight;
}

}  // namespace dhpmap
