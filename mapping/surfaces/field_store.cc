// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/field_store.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

/// Whether a change may invalidate a field. A removed surface counts by its distance only: what a field contains of it
/// is within the horizon. An added surface must be nearer than the field's own surfaces somewhere in the cell.
bool Concerns(const SurfaceChange& change, const NearField& field, const FieldReach& reach) {
  constexpr double kSlack_m = 1e-4;
  const std::vector<SubmapId>& held = field.submaps();
  if (change.is_gone && std::find(held.begin(), held.end(), change.submap) == held.end()) return false;
  const Eigen::Vector3d centre_m = change.T_submap_map * field.centre_m();
  const double horizon_m = field.horizon_m() + kSlack_m;
  const auto is_in_horizon = [&](const Eigen::AlignedBox3d& box) {
    return box.squaredExteriorDistance(centre_m) <= horizon_m * horizon_m;
  };
  if (!is_in_horizon(change.around_m)) return false;
  if (change.is_gone) return std::any_of(change.boxes_m.begin(), change.boxes_m.end(), is_in_horizon);
  const FieldReach in_submap = reach.In(change.T_submap_map.linear().cast<float>(), Eigen::Vector3f::Zero());
  return std::any_of(change.boxes_m.begin(), change.boxes_m.end(), [&](const Eigen::AlignedBox3d& box) {
    return in_submap({(box.min() - centre_m).cast<float>(), (box.max() - centre_m).cast<float>()});
  });
}

/// Whether nothing near the field has changed.
bool Holds(const NearField& field, const std::vector<std::shared_ptr<const std::vector<SurfaceChange>>>& changes) {
  const FieldReach reach = field.Reach();
  for (const auto& of_state : changes) {
    for (const SurfaceChange& change : *of_state) {
      if (Concerns(change, field, reach)) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<std::uint64_t> FieldStore::Append(std::uint64_t before, std::vector<SurfaceChange> changed) {
  constexpr std::size_t kMostChanges = 256;  // fields not requested within this many states are made again
  auto changes = std::make_shared<const std::vector<SurfaceChange>>(std::move(changed));
  Changes forgotten;
  const MutexLock lock(mutex_);
  if (before != last_) return std::nullopt;
  changes_.push_back(std::move(changes));
  if (changes_.size() > kMostChanges) {
    forgotten = std::move(changes_.front());
    changes_.pop_front();
  }
  return ++last_;
}

std::optional<std::vector<FieldStore::Changes>> FieldStore::ChangesSince(const Entry& entry,
                                                                         std::uint64_t state) const {
  if (last_ - entry.checked > changes_.size()) return std::nullopt;
  const auto first = changes_.end() - static_cast<std::ptrdiff_t>(last_ - entry.checked);
  return std::vector<Changes>(first, first + static_cast<std::ptrdiff_t>(state - entry.checked));
}

std::shared_ptr<const NearField> FieldStore::Find(BlockIndex block, std::uint64_t state) {
  Entry known;
  std::optional<std::vector<Changes>> changes;
  {
    const MutexLock lock(mutex_);
    const auto found = entries_.find(block);
    if (found == entries_.end() || state < found->second.made) return nullptr;
    found->second.last_used = ledger_->time.load(std::memory_order_relaxed);
    if (state <= found->second.checked) return found->second.field;
    known = found->second;
    changes = ChangesSince(known, state);
  }
  const bool holds = changes && Holds(*known.field, *changes);
  const MutexLock lock(mutex_);
  const auto found = entries_.find(block);
  if (found == entries_.end() || found->second.field != known.field) return holds ? known.field : nullptr;
  if (state <= found->second.checked) return known.field;  // another thread has confirmed it meanwhile
  if (holds) {
    found->second.checked = state;
    return known.field;
  }
  bytes_ -= known.field->MemoryBytes();
  entries_.erase(found);
  return nullptr;
}

void FieldStore::Put(BlockIndex block, std::uint64_t state, std::shared_ptr<const NearField> field) {
  Fields dropped;
  const MutexLock lock(mutex_);
  if (bytes_ + field->MemoryBytes() > ledger_->most_field_bytes) DropOldest(dropped);
  Entry& entry = entries_[block];
  if (entry.field != nullptr) {
    if (entry.checked > state) return;  // the other one is newer
    bytes_ -= entry.field->MemoryBytes();
  }
  bytes_ += field->MemoryBytes();
  field = std::exchange(entry, {std::move(field), state, state, ledger_->time.load(std::memory_order_relaxed)}).field;
}

/// Drops half of them, so that it happens rarely.
void FieldStore::DropOldest(Fields& dropped) {
  if (entries_.empty()) return;
  std::vector<std::uint64_t> times;
  for (const auto& [block, entry] : entries_) times.push_back(entry.last_used);
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  const std::uint64_t last_to_go = *middle;
  dropped.reserve(entries_.size());
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->second.last_used > last_to_go) {
      ++entry;
      continue;
    }
    bytes_ -= entry->second.field->MemoryBytes();
    dropped.push_back(std::move(entry->second.field));
    entry = entries_.erase(entry);
  }
}

std::size_t FieldStore::num_fields() const {
  const MutexLock lock(mutex_);
  return entries_.size();
}

}  // namespace dhpmap
