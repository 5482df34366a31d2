// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/surface_cache.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "mapping/surfaces/thing_inside.h"

namespace dhpmap {
namespace {

constexpr std::size_t kCentre = 13;  // index in a TileNeighbourhood

/// Surfaces that keep their state alive.
std::shared_ptr<const MapSurfaces> HoldBoth(std::shared_ptr<const MapSnapshot> state,
                                            std::shared_ptr<const MapSurfaces> surfaces) {
  const MapSurfaces* both = surfaces.get();
  using Both = std::pair<std::shared_ptr<const MapSnapshot>, std::shared_ptr<const MapSurfaces>>;
  return {std::make_shared<const Both>(std::move(state), std::move(surfaces)), both};
}

/// Drops entries whose keys have been destroyed.
template <typename Map>
void DropExpired(Map& map, std::vector<std::shared_ptr<const void>>& forgotten) {
  std::erase_if(map, [&](const auto& known) {
    if (!known.second.key.expired()) return false;
    forgotten.push_back(known.second.value);
    return true;
  });
}

}  // namespace

MapSurfaces::MapSurfaces(const MapSnapshot& state, std::unique_ptr<const GridSharers> grid, std::vector<Part> parts,
                         const std::shared_ptr<SurfaceLedger>& ledger, const MapSurfaces* before)
    : state_(state),
      voxel_size_m_(state.info().config.voxel_size_m),
      grid_(std::move(grid)),
      parts_(std::move(parts)),
      index_(IndexOf(parts_, before)),
      things_(ThingsOf(index_)),
      things_centre_m_(index_.box_m().isEmpty() ? Eigen::Vector3d(0, 0, 0) : index_.box_m().center()),
      thing_tree_(TreeOfThings()) {
  GoOnFrom(before, ledger);
}

BoxTree MapSurfaces::TreeOfThings() const {
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const Thing& thing : things_) boxes.push_back(ThingBox(thing.around_m));
  return BoxTree(boxes);
}

Eigen::AlignedBox3f MapSurfaces::ThingBox(const Eigen::AlignedBox3d& box_m) const {
  constexpr double kRounding = 1e-6;
  const Eigen::Vector3d low = box_m.min() - things_centre_m_, high = box_m.max() - things_centre_m_;
  return {(low - kRounding * low.cwiseAbs()).cast<float>(), (high + kRounding * high.cwiseAbs()).cast<float>()};
}

void MapSurfaces::GoOnFrom(const MapSurfaces* before, const std::shared_ptr<SurfaceLedger>& ledger) {
  std::shared_ptr<const NearbyCells::Earlier> cells;
  std::shared_ptr<FieldStore> store;
  std::uint64_t field_state = FieldStore::kFirst;
  if (before != nullptr && before->voxel_size_m_ == voxel_size_m_) {
    std::vector<SurfaceChange> changes = ChangesSince(*before);
    before->cells_->LeaveEarlier();
    cells = CellsOf(*before, changes);
    store = before->fields_->store();
    if (const auto number = store->Append(before->fields_->state(), std::move(changes))) field_state = *number;
    else store = nullptr;
  }
  if (store == nullptr) store = std::make_shared<FieldStore>(ledger);
  cells_ = std::make_shared<const NearbyCells>(index_.box_m(), voxel_size_m_, ledger, std::move(cells));
  fields_ = std::make_unique<const DistanceFields>(index_.box_m(), voxel_size_m_, std::move(store), field_state);
}

/// The cells of an earlier state that remain valid; only data copied to this object are used. Null: too much has
/// changed.
std::shared_ptr<const NearbyCells::Earlier> MapSurfaces::CellsOf(const MapSurfaces& before,
                                                                 std::span<const SurfaceChange> changes) const {
  auto earlier = std::make_shared<NearbyCells::Earlier>();
  earlier->cells = before.cells_;
  earlier->parts.resize(before.parts_.size());
  for (std::size_t number = 0; number < before.parts_.size(); ++number) {
    const std::size_t now = NumberOf(before.parts_[number].id);
    if (now == parts_.size()) continue;
    const Transform &T_then = before.index_.entries()[number].T_submap_map(),
                    &T_now = index_.entries()[now].T_submap_map();
    if (T_then.matrix() != T_now.matrix()) continue;
    NearbyCells::Earlier::Part& part = earlier->parts[number];
    part.number = static_cast<std::uint32_t>(now);
    part.is_same = before.parts_[number].surface == parts_[now].surface;
    if (!part.is_same) part.tiles = before.surface(number).PositionsIn(surface(now));
  }
  constexpr std::size_t kMostNew = 256;  // boxes: checking more would cost as much as making a cell
  for (const SurfaceChange& change : changes) {
    if (change.is_gone) continue;
    if (earlier->new_m.size() + change.boxes_m.size() > kMostNew) return nullptr;
    const Transform T_map_submap = change.T_submap_map.inverse();
    for (const Eigen::AlignedBox3d& box_m : change.boxes_m) earlier->new_m.push_back(box_m.transformed(T_map_submap));
  }
  return earlier;
}

std::size_t MapSurfaces::NumberOf(SubmapId id) const {
  const auto part =
      std::lower_bound(parts_.begin(), parts_.end(), id, [](const Part& a, SubmapId b) { return a.id < b; });
  return part != parts_.end() && part->id == id ? static_cast<std::size_t>(part - parts_.begin()) : parts_.size();
}

std::shared_ptr<const SubmapSurface> MapSurfaces::SurfaceOf(SubmapId id) const {
  const std::size_t number = NumberOf(id);
  return number < parts_.size() ? parts_[number].surface : nullptr;
}

bool MapSurfaces::Holds(std::span<const SubmapId> needed, const std::vector<bool>& is_there) const {
  return is_there.empty() || std::all_of(needed.begin(), needed.end(), [&](SubmapId id) {
           const std::size_t number = NumberOf(id);
           return number < is_there.size() && is_there[number];
         });
}

/// Uses only data copied to this object: the earlier state may have been destroyed.
std::vector<SurfaceChange> MapSurfaces::ChangesSince(const MapSurfaces& before) const {
  std::vector<SurfaceChange> changes;
  const auto add = [&changes](const MapSurfaces& state, std::size_t number, bool is_gone, const SubmapSurface* other) {
    SurfaceChange change{.submap = state.parts_[number].id,
                         .is_gone = is_gone,
                         .T_submap_map = state.index_.entries()[number].T_submap_map(),
                         .boxes_m = {},
                         .around_m = {}};
    state.surface(number).AppendBoxes(other, change.boxes_m);
    for (const Eigen::AlignedBox3d& box : change.boxes_m) change.around_m.extend(box);
    if (!change.boxes_m.empty()) changes.push_back(std::move(change));
  };
  const std::span<const SubmapIndex::Entry> old_entries = before.index_.entries(), new_entries = index_.entries();
  std::size_t was = 0, is = 0;
  while (was < old_entries.size() || is < new_entries.size()) {
    const bool is_only_old =
        is == new_entries.size() || (was < old_entries.size() && before.parts_[was].id < parts_[is].id);
    if (is_only_old) {
      add(before, was++, true, nullptr);
      continue;
    }
    if (was == old_entries.size() || parts_[is].id < before.parts_[was].id) {
      add(*this, is++, false, nullptr);
      continue;
    }
    const std::size_t old_one = was++, new_one = is++;
    const SubmapSurface &old_surface = before.surface(old_one), &new_surface = surface(new_one);
    const bool is_moved = old_entries[old_one].T_submap_map().matrix() != new_entries[new_one].T_submap_map().matrix();
    if (&old_surface == &new_surface && !is_moved) continue;
    add(before, old_one, true, is_moved ? nullptr : &new_surface);
    add(*this, new_one, false, is_moved ? nullptr : &old_surface);
  }
  return changes;
}

SubmapIndex MapSurfaces::IndexOf(const std::vector<Part>& parts, const MapSurfaces* before) {
  const bool has_before = before != nullptr && before->parts_.size() == parts.size();
  std::vector<SubmapIndex::Entry> entries;
  entries.reserve(parts.size());
  std::vector<std::size_t> changed;
  for (std::size_t number = 0; number < parts.size(); ++number) {
    const Part& part = parts[number];
    entries.emplace_back(*part.submap, part.surface->box_m());
    if (has_before && !entries.back().IsPlacedAs(before->index_.entries()[number])) changed.push_back(number);
  }
  if (!has_before) return SubmapIndex(std::move(entries));
  return {before->index_, std::move(entries), changed};
}

std::vector<MapSurfaces::Thing> MapSurfaces::ThingsOf(const SubmapIndex& index) {
  std::vector<Thing> things;
  for (std::size_t number = 0; number < index.entries().size(); ++number) {
    const SubmapIndex::Entry& entry = index.entries()[number];
    const SubmapInfo& info = entry.submap().info();
    if (info.panoptic != Panoptic::kThing) continue;
    things.push_back({static_cast<std::uint32_t>(number), MayBeInside(entry.box_m()).transformed(info.T_map_submap)});
  }
  return things;
}

SurfaceCache::SurfaceCache(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {
  ledger_->most_field_bytes = limit_bytes / 2;
}

std::size_t SurfaceCache::num_tiles() const {
  const MutexLock lock(mutex_);
  return slots_.size();
}

std::shared_ptr<const MapSurfaces> SurfaceCache::Of(const std::shared_ptr<const MapSnapshot>& state, bool with_absent) {
  ledger_->time.fetch_add(1, std::memory_order_relaxed);
  {
    const MutexLock lock(mutex_);
    asked_[state->info().name] = Clock::now();
  }
  const auto is_absent = [](const auto& submap) { return submap->IsAbsent(); };
  return Find(state, with_absent && std::any_of(state->submaps().begin(), state->submaps().end(), is_absent));
}

bool SurfaceCache::IsWanted(const std::string& map) const {
  constexpr std::chrono::seconds kLately{2};
  const MutexLock lock(mutex_);
  const auto asked = asked_.find(map);
  return asked != asked_.end() && Clock::now() - asked->second < kLately;
}

void SurfaceCache::Freshen(const std::shared_ptr<const MapSnapshot>& state, const std::stop_token& stop) {
  constexpr std::uint64_t kLately = 256;  // in queries
  if (!IsWanted(state->info().name)) return;
  const std::uint64_t now = ledger_->time.load(std::memory_order_relaxed);
  const std::shared_ptr<const MapSurfaces> surfaces = Find(state, false);
  const std::span<const SubmapIndex::Entry> entries = surfaces->index().entries();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    surfaces->surface(i).PrepareUsedSince(now > kLately ? now - kLately : 1, *state, entries[i].submap(), stop);
  }
}

std::shared_ptr<const MapSurfaces> SurfaceCache::Find(const std::shared_ptr<const MapSnapshot>& state,
                                                      bool with_absent) {
  std::shared_ptr<const MapSurfaces> before;
  if (ledger_->bytes + ledger_->cell_bytes > limit_bytes_) Evict();
  {
    Forgotten forgotten;
    const MutexLock lock(mutex_);
    DropOldStates(forgotten);
    States& states = states_[with_absent ? 1 : 0];
    if (const auto known = states.known.find(state.get()); known != states.known.end()) {
      std::deque<const MapSnapshot*>& asked = states.asked[state->info().name];
      std::erase(asked, state.get());
      asked.push_back(state.get());
      return HoldBoth(state, known->second.value);
    }
    if (const auto last = states.latest.find(state->info().name); last != states.latest.end()) before = last->second;
  }
  std::shared_ptr<const MapSurfaces> made = Make(*state, with_absent, before.get());
  Forgotten forgotten;
  const MutexLock lock(mutex_);
  if (slots_.size() + submaps_.size() > sweep_at_) Sweep(forgotten);
  if (asked_.contains(state->info().name)) {  // else it was evicted meanwhile
    Remember(states_[with_absent ? 1 : 0], state, made, forgotten);
  }
  return HoldBoth(state, std::move(made));
}

/// Keeps a few states of each map: pinned states do not keep all surfaces made for them.
void SurfaceCache::Remember(States& states, const std::shared_ptr<const MapSnapshot>& state,
                            const std::shared_ptr<const MapSurfaces>& made, Forgotten& forgotten) {
  constexpr std::size_t kMostOfAMap = 4;
  forgotten.push_back(std::exchange(states.known[state.get()], {state, made}).value);
  forgotten.push_back(std::exchange(states.latest[state->info().name], made));
  std::deque<const MapSnapshot*>& asked = states.asked[state->info().name];
  std::erase(asked, state.get());
  asked.push_back(state.get());
  if (asked.size() <= kMostOfAMap) return;
  // Another state may have this address by now: its surfaces are made again.
  if (const auto oldest = states.known.find(asked.front()); oldest != states.known.end()) {
    forgotten.push_back(oldest->second.value);
    states.known.erase(oldest);
  }
  asked.pop_front();
}

std::shared_ptr<const MapSurfaces> SurfaceCache::Make(const MapSnapshot& state, bool with_absent,
                                                      const MapSurfaces* before) {
  auto grid = std::make_unique<const GridSharers>(state, before == nullptr ? nullptr : before->grid());
  std::vector<MapSurfaces::Part> parts;
  for (const auto& submap : state.submaps()) {
    if (submap->IsAbsent() && !with_absent) continue;
    std::shared_ptr<const SubmapSurface> surface =
        SurfaceOf(submap, GridSharers::Takes(state, *submap) ? grid.get() : nullptr,
                  before == nullptr ? nullptr : before->SurfaceOf(submap->id()));
    if (!surface->box_m().isEmpty()) parts.push_back({submap.get(), submap->id(), std::move(surface)});
  }
  return std::make_shared<const MapSurfaces>(state, std::move(grid), std::move(parts), ledger_, before);
}

std::shared_ptr<const SubmapSurface> SurfaceCache::SurfaceOf(const std::shared_ptr<const Submap>& submap,
                                                             const GridSharers* grid,
                                                             const std::shared_ptr<const SubmapSurface>& before) {
  std::uint64_t num_evictions = 0;
  std::shared_ptr<const SubmapSurface> there;
  {
    const MutexLock lock(mutex_);
    const auto known = submaps_.find(submap.get());
    if (known != submaps_.end() && !known->second.key.expired()) there = known->second.value;
    num_evictions = num_evictions_;
  }
  if (there != nullptr && there->IsOf(*submap, grid)) return there;
  auto made = std::make_shared<const SubmapSurface>(*submap, grid, there.get(), [&](std::span<const TilePlace> places) {
    return SlotsOf(places, submap->info().voxel_size_m, before.get());
  });
  if (before != nullptr && before->IsSameAs(*made)) made = before;  // it was renamed, moved or relabelled
  Known<Submap, SubmapSurface> now{submap, made};
  const MutexLock lock(mutex_);
  // Otherwise it may contain slots evicted meanwhile, which the cache would no longer count.
  if (num_evictions == num_evictions_) std::swap(submaps_[submap.get()], now);
  return made;
}

/// Slots of the same tiles, of equal earlier tiles, or new ones. Compares tiles without the mutex: a nice thread that
/// is preempted would block all others.
SubmapSurface::Slots SurfaceCache::SlotsOf(std::span<const TilePlace> places, double voxel_size_m,
                                           const SubmapSurface* before) {
  const auto centre_of = [](const TilePlace& place) -> const std::shared_ptr<const BlockTile>& {
    return place.around[kCentre]->tile;
  };
  SubmapSurface::Slots known(places.size());
  {
    const MutexLock lock(mutex_);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto found = slots_.find(centre_of(places[i]).get());
      if (found != slots_.end() && !found->second.key.expired()) known[i] = found->second.value;
    }
  }
  SubmapSurface::Slots slots = known;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const TilePlace& place = places[i];
    const auto fits = [&](const Slot& slot) { return slot != nullptr && slot->IsOf(place, voxel_size_m); };
    if (fits(slots[i])) continue;
    if (Slot earlier = before == nullptr ? nullptr : before->SlotAt(place.tile); fits(earlier)) {
      slots[i] = std::move(earlier);
    } else {
      const std::uint64_t last_used = earlier == nullptr ? 0 : earlier->last_used();
      slots[i] = std::make_shared<const TileSurfaceSlot>(place, voxel_size_m, ledger_, last_used);
    }
  }
  Forgotten forgotten;
  forgotten.reserve(places.size());
  const MutexLock lock(mutex_);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Known<BlockTile, TileSurfaceSlot>& there = slots_[centre_of(places[i]).get()];  // may have been evicted meanwhile
    if (there.value == slots[i] && !there.key.expired()) continue;
    const bool is_new = !there.key.expired() && there.value != known[i];  // another thread has added it
    if (is_new && there.value->IsOf(places[i], voxel_size_m)) {
      forgotten.push_back(std::exchange(slots[i], there.value));
      continue;
    }
    forgotten.push_back(std::exchange(there, {centre_of(places[i]), slots[i]}).value);
  }
  return slots;
}

void SurfaceCache::Forget(const std::string& map) {
  Forgotten forgotten;
  const MutexLock lock(mutex_);
  for (States& states : states_) {
    if (const auto latest = states.latest.find(map); latest != states.latest.end()) {
      forgotten.push_back(latest->second);
      states.latest.erase(latest);
    }
    states.asked.erase(map);
  }
  asked_.erase(map);
  DropOldStates(forgotten);
  Sweep(forgotten);
}

void SurfaceCache::DropOldStates(Forgotten& forgotten) {
  for (States& states : states_) DropExpired(states.known, forgotten);
}

/// Drops entries that nobody uses any longer. Linear in the number of entries, so it runs when that has grown by a
/// quarter: during mapping each queried state leaves surfaces behind.
void SurfaceCache::Sweep(Forgotten& forgotten) {
  DropExpired(slots_, forgotten);
  DropExpired(submaps_, forgotten);
  sweep_at_ = (slots_.size() + submaps_.size()) / 4 * 5 + 64;
}

void SurfaceCache::ForgetStates(Forgotten& forgotten) {
  for (States& states : states_) {
    for (const auto& [map, surfaces] : states.latest) forgotten.push_back(surfaces);
    for (const auto& [state, known] : states.known) forgotten.push_back(known.value);
    states.latest.clear();
    states.known.clear();
    states.asked.clear();
  }
}

/// Only one thread evicts; others continue meanwhile.
void SurfaceCache::Evict() {
  {
    const MutexLock lock(mutex_);
    if (is_evicting_ || ledger_->bytes + ledger_->cell_bytes <= limit_bytes_) return;
    is_evicting_ = true;
  }
  try {
    {
      Forgotten forgotten;
      const MutexLock lock(mutex_);
      ForgetStates(forgotten);
      Sweep(forgotten);
    }
    DropUnused();
  } catch (...) {
    const MutexLock lock(mutex_);
    is_evicting_ = false;
    throw;
  }
  const MutexLock lock(mutex_);
  is_evicting_ = false;
}

/// Evicts the least recently used surfaces, and all that refers to them, until three quarters of the limit are left.
/// Cells are counted at their current size: those of evicted states are freed already, unless in use.
void SurfaceCache::DropUnused() {
  Forgotten forgotten;
  std::unordered_set<Slot> made;  // several tiles may share one
  {
    const MutexLock lock(mutex_);
    for (const auto& [tile, known] : slots_) {
      if (known.value->bytes() > 0) made.insert(known.value);
    }
  }
  // Copy the times of use, because other threads keep updating them.
  std::vector<std::pair<std::uint64_t, const TileSurfaceSlot*>> by_use;
  by_use.reserve(made.size());
  std::size_t bytes = ledger_->cell_bytes;
  for (const Slot& slot : made) {
    by_use.emplace_back(slot->last_used(), slot.get());
    bytes += slot->bytes();
  }
  std::sort(by_use.begin(), by_use.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::unordered_set<const TileSurfaceSlot*> dropped;
  for (const auto& [last_used, slot] : by_use) {
    if (bytes <= limit_bytes_ / 4 * 3) break;
    bytes -= slot->bytes();
    dropped.insert(slot);
  }
  if (dropped.empty()) return;
  const MutexLock lock(mutex_);
  ++num_evictions_;
  ForgetStates(forgotten);  // states queried since
  std::erase_if(submaps_, [&](const auto& known) {
    bool is_hit = false;
    known.second.value->ForEachSlot([&](const TileSurfaceSlot& slot) { is_hit |= dropped.contains(&slot); });
    if (is_hit) forgotten.push_back(known.second.value);
    return is_hit;
  });
  std::erase_if(slots_, [&](const auto& slot) { return dropped.contains(slot.second.value.get()); });
}

}  // namespace dhpmap
