// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/surface_cache.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace dhpmap {
namespace {

constexpr std::size_t kCentre = 13;  // of a TileNeighbourhood

/// Surfaces that keep the state alive they refer to.
std::shared_ptr<const MapSurfaces> HoldBoth(std::shared_ptr<const MapSnapshot> state,
                                            std::shared_ptr<const MapSurfaces> surfaces) {
  const MapSurfaces* both = surfaces.get();
  using Both = std::pair<std::shared_ptr<const MapSnapshot>, std::shared_ptr<const MapSurfaces>>;
  return {std::make_shared<const Both>(std::move(state), std::move(surfaces)), both};
}

}  // namespace

MapSurfaces::MapSurfaces(const MapSnapshot& state, std::vector<Part> parts,
                         const std::shared_ptr<SurfaceLedger>& ledger, const MapSurfaces* before)
    : state_(state),
      voxel_size_m_(state.info().config.voxel_size_m),
      parts_(std::move(parts)),
      index_(IndexOf(parts_, before)),
      cells_(index_.box_m(), voxel_size_m_, ledger),
      fields_(FieldsAfter(before, ledger)) {}

DistanceFields MapSurfaces::FieldsAfter(const MapSurfaces* before, const std::shared_ptr<SurfaceLedger>& ledger) const {
  if (before != nullptr && before->voxel_size_m_ == voxel_size_m_) {
    const std::shared_ptr<FieldStore>& store = before->fields_.store();
    if (const auto number = store->Append(before->fields_.state(), ChangesSince(*before))) {
      return {index_.box_m(), voxel_size_m_, store, *number};
    }
  }
  return {index_.box_m(), voxel_size_m_, std::make_shared<FieldStore>(ledger), FieldStore::kFirst};
}

const SubmapSurface* MapSurfaces::SurfaceOf(SubmapId id) const {
  const auto part =
      std::lower_bound(parts_.begin(), parts_.end(), id, [](const Part& a, SubmapId b) { return a.id < b; });
  return part != parts_.end() && part->id == id ? part->surface.get() : nullptr;
}

/// Of what was, only what this has copies of: the state may be gone.
std::vector<Eigen::AlignedBox3d> MapSurfaces::ChangesSince(const MapSurfaces& before) const {
  std::vector<Eigen::AlignedBox3d> boxes_m;
  const auto add_all = [&boxes_m](const SubmapIndex::Entry& entry) {
    boxes_m.push_back(entry.box_m().transformed(entry.T_submap_map().inverse()));
  };
  const std::span<const SubmapIndex::Entry> old_entries = before.index_.entries(), new_entries = index_.entries();
  std::size_t was = 0, is = 0;
  while (was < old_entries.size() || is < new_entries.size()) {
    const bool is_only_old =
        is == new_entries.size() || (was < old_entries.size() && before.parts_[was].id < parts_[is].id);
    if (is_only_old) {
      add_all(old_entries[was++]);
      continue;
    }
    if (was == old_entries.size() || parts_[is].id < before.parts_[was].id) {
      add_all(new_entries[is++]);
      continue;
    }
    const SubmapIndex::Entry &old_one = old_entries[was], &new_one = new_entries[is];
    const SubmapSurface &old_surface = before.surface(was++), &new_surface = surface(is++);
    if (&old_surface == &new_surface) continue;
    if (old_one.T_submap_map().matrix() != new_one.T_submap_map().matrix()) {
      add_all(old_one);
      add_all(new_one);
      continue;
    }
    const std::size_t first = boxes_m.size();
    const Transform T_map_submap = new_one.T_submap_map().inverse();
    new_surface.AppendChanges(old_surface, boxes_m);
    for (std::size_t i = first; i < boxes_m.size(); ++i) boxes_m[i] = boxes_m[i].transformed(T_map_submap);
  }
  return boxes_m;
}

/// The surface tells a submap from all others that there have been: submaps that are gone may have had the same
/// address.
SubmapIndex MapSurfaces::IndexOf(const std::vector<Part>& parts, const MapSurfaces* before) {
  const std::size_t num_before = before == nullptr ? 0 : before->parts_.size();
  std::vector<SubmapIndex::Entry> entries;
  entries.reserve(parts.size());
  std::vector<std::size_t> changed;
  for (std::size_t number = 0; number < parts.size(); ++number) {
    const Part& part = parts[number];
    if (number < num_before && before->parts_[number].surface == part.surface) {
      entries.push_back(before->index_.entries()[number]);
    } else {
      entries.emplace_back(*part.submap, part.surface->box_m());
      changed.push_back(number);
    }
  }
  if (before == nullptr || num_before != parts.size()) return SubmapIndex(std::move(entries));
  return {before->index_, std::move(entries), changed};
}

SurfaceCache::SurfaceCache(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {
  ledger_->most_field_bytes = limit_bytes / 2;
}

std::size_t SurfaceCache::num_tiles() const {
  const MutexLock lock(mutex_);
  return slots_.size();
}

std::shared_ptr<const MapSurfaces> SurfaceCache::Of(const std::shared_ptr<const MapSnapshot>& state) {
  ledger_->time.fetch_add(1, std::memory_order_relaxed);
  {
    const MutexLock lock(mutex_);
    asked_[state->info().name] = Clock::now();
  }
  return Find(state);
}

bool SurfaceCache::IsWanted(const std::string& map) const {
  constexpr std::chrono::seconds kLately{2};
  const MutexLock lock(mutex_);
  const auto asked = asked_.find(map);
  return asked != asked_.end() && Clock::now() - asked->second < kLately;
}

void SurfaceCache::Freshen(const std::shared_ptr<const MapSnapshot>& state, const std::stop_token& stop) {
  constexpr std::uint64_t kLately = 64;  // questions
  if (!IsWanted(state->info().name)) return;
  const std::uint64_t now = ledger_->time.load(std::memory_order_relaxed);
  const std::shared_ptr<const MapSurfaces> surfaces = Find(state);
  const std::span<const SubmapIndex::Entry> entries = surfaces->index().entries();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    surfaces->surface(i).PrepareUsedSince(now > kLately ? now - kLately : 1, entries[i].submap(), stop);
  }
}

std::shared_ptr<const MapSurfaces> SurfaceCache::Find(const std::shared_ptr<const MapSnapshot>& state) {
  std::shared_ptr<const MapSurfaces> before;
  {
    const MutexLock lock(mutex_);
    if (ledger_->bytes + ledger_->cell_bytes > limit_bytes_) Evict();
    std::erase_if(states_, [](const auto& known) { return known.second.key.expired(); });
    if (const auto known = states_.find(state.get()); known != states_.end()) {
      return HoldBoth(state, known->second.value);
    }
    if (const auto latest = latest_.find(state->info().name); latest != latest_.end()) before = latest->second;
  }
  std::shared_ptr<const MapSurfaces> made = Make(*state, before.get());
  const MutexLock lock(mutex_);
  if (slots_.size() + submaps_.size() > sweep_at_) Sweep();
  if (asked_.contains(state->info().name)) {  // else it was forgotten meanwhile
    states_.insert_or_assign(state.get(), Known<MapSnapshot, MapSurfaces>{state, made});
    latest_[state->info().name] = made;
  }
  return HoldBoth(state, std::move(made));
}

std::shared_ptr<const MapSurfaces> SurfaceCache::Make(const MapSnapshot& state, const MapSurfaces* before) {
  std::vector<MapSurfaces::Part> parts;
  for (const auto& submap : state.submaps()) {
    if (submap->IsAbsent()) continue;
    std::shared_ptr<const SubmapSurface> surface =
        SurfaceOf(submap, before == nullptr ? nullptr : before->SurfaceOf(submap->id()));
    if (!surface->box_m().isEmpty()) parts.push_back({submap.get(), submap->id(), std::move(surface)});
  }
  return std::make_shared<const MapSurfaces>(state, std::move(parts), ledger_, before);
}

std::shared_ptr<const SubmapSurface> SurfaceCache::SurfaceOf(const std::shared_ptr<const Submap>& submap,
                                                             const SubmapSurface* before) {
  {
    const MutexLock lock(mutex_);
    const auto known = submaps_.find(submap.get());
    if (known != submaps_.end() && !known->second.key.expired()) return known->second.value;
  }
  auto made = std::make_shared<const SubmapSurface>(*submap, [&](const TileNeighbourhood& around, TileIndex tile) {
    return SlotOf(around, tile, submap->info().voxel_size_m, before);
  });
  const MutexLock lock(mutex_);
  submaps_.insert_or_assign(submap.get(), Known<Submap, SubmapSurface>{submap, made});
  return made;
}

/// That of the same tile, of one before it that shows the same, or a new one.
SurfaceCache::Slot SurfaceCache::SlotOf(const TileNeighbourhood& around, TileIndex tile, double voxel_size_m,
                                        const SubmapSurface* before) {
  const std::shared_ptr<const BlockTile>& centre = around[kCentre]->tile;
  const auto fits = [&](const Slot& slot) { return slot != nullptr && slot->IsOf(around, tile, voxel_size_m); };
  {
    const MutexLock lock(mutex_);
    const auto known = slots_.find(centre.get());
    if (known != slots_.end() && !known->second.key.expired() && fits(known->second.value)) return known->second.value;
  }
  Slot slot = before == nullptr ? nullptr : before->SlotAt(tile);
  if (!fits(slot)) {
    const std::uint64_t last_used = slot == nullptr ? 0 : slot->last_used();
    slot = std::make_shared<const TileSurfaceSlot>(around, tile, voxel_size_m, ledger_, last_used);
  }
  const MutexLock lock(mutex_);
  Known<BlockTile, TileSurfaceSlot>& known = slots_[centre.get()];
  const bool is_there = !known.key.expired() && fits(known.value);  // somebody else has been here
  if (!is_there) known = {centre, std::move(slot)};
  return known.value;
}

void SurfaceCache::Forget(const std::string& map) {
  const MutexLock lock(mutex_);
  latest_.erase(map);
  asked_.erase(map);
  std::erase_if(states_, [](const auto& known) { return known.second.key.expired(); });
  Sweep();
}

/// Forgets what nobody has any longer. Costs as much as there is, so it comes when that has grown by a quarter: while
/// frames come, each state that is asked about leaves surfaces behind.
void SurfaceCache::Sweep() {
  std::erase_if(slots_, [](const auto& slot) { return slot.second.key.expired(); });
  std::erase_if(submaps_, [](const auto& known) { return known.second.key.expired(); });
  sweep_at_ = (slots_.size() + submaps_.size()) / 4 * 5 + 64;
}

/// Forgets surfaces, until what is left takes three quarters of the limit, and all that refers to them.
void SurfaceCache::Evict() {
  latest_.clear();
  Sweep();
  states_.clear();                // and their cells, but for those in use
  std::unordered_set<Slot> made;  // several tiles may show the same
  for (const auto& [tile, known] : slots_) {
    if (known.value->bytes() > 0) made.insert(known.value);
  }
  std::vector<Slot> by_use(made.begin(), made.end());
  std::sort(by_use.begin(), by_use.end(), [](const Slot& a, const Slot& b) { return a->last_used() < b->last_used(); });
  std::size_t bytes = ledger_->cell_bytes;
  for (const Slot& slot : by_use) bytes += slot->bytes();
  std::unordered_set<const TileSurfaceSlot*> dropped;
  for (const Slot& slot : by_use) {
    if (bytes <= limit_bytes_ / 4 * 3) break;
    bytes -= slot->bytes();
    dropped.insert(slot.get());
  }
  if (dropped.empty()) return;
  std::erase_if(slots_, [&](const auto& slot) { return dropped.contains(slot.second.value.get()); });
  std::erase_if(submaps_, [&](const auto& known) {
    bool is_hit = false;
    known.second.value->ForEachSlot([&](const TileSurfaceSlot& slot) { is_hit |= dropped.contains(&slot); });
    return is_hit;
  });
}

}  // namespace dhpmap
