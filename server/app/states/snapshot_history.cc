// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/snapshot_history.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mapping/paging/tile_directory.h"
#include "server/app/states/etag.h"
#include "server/app/states/state_bytes.h"

namespace dhpmap {
namespace {

Status RevisionNotReached(std::int64_t revision, const MapSnapshot& present, const std::string& field) {
  return InvalidArgument("map '" + present.info().name + "' is at revision " + std::to_string(present.revision()))
      .WithReason("BAD_REVISION")
      .WithViolation(field, std::to_string(revision) + (revision <= 0 ? " is not above 0" : " was not reached yet"));
}

Status RevisionNotKept(std::int64_t revision, const MapSnapshot& present, const SnapshotHistory::Neighbours& nearest) {
  const std::string before = nearest.before ? std::to_string(*nearest.before) : std::string();
  const std::string after = std::to_string(nearest.after.value_or(present.revision()));
  Status status = OutOfRange("revision " + std::to_string(revision) + " of map '" + present.info().name +
                             "' is not kept: the nearest that can be read " +
                             (before.empty() ? "is " : "are " + before + " and ") + after)
                      .WithReason("REVISION_NOT_KEPT")
                      .WithMetadata("revision_after", after);
  if (before.empty()) return status;
  return std::move(status).WithMetadata("revision_before", before);
}

}  // namespace

SnapshotHistory::SnapshotHistory(std::size_t max_states, std::shared_ptr<ByteBudget> budget)
    : max_states_(max_states), budget_(std::move(budget)), share_(budget_.get()) {}

SnapshotHistory::State SnapshotHistory::Newest() const {
  const MutexLock lock(mutex_);
  return kept_.empty() ? nullptr : kept_.back().state;
}

void SnapshotHistory::Keep(State state) {
  const State before = Newest();
  if (max_states_ == 0 || (before != nullptr && before->revision() >= state->revision())) return;
  const std::size_t bytes = before != nullptr ? StateBytesNotIn(*before, *state) : 0;
  std::vector<Kept> dropped;  // freed after the mutex is released, because it may take long
  View last_view;
  const MutexLock lock(mutex_);
  dropped.reserve(kept_.size());
  const bool has_before = before != nullptr && !kept_.empty();  // EvictPages may have run meanwhile
  kept_.push_back({std::move(state), 0});
  if (has_before) kept_[kept_.size() - 2].bytes = bytes;
  std::size_t all = share_.bytes() + (has_before ? bytes : 0);
  while (kept_.size() > max_states_ || !share_.Resize(all)) {  // ends: the newest state takes no bytes
    all -= kept_.front().bytes;
    dropped.push_back(std::move(kept_.front()));
    kept_.pop_front();
  }
  const bool is_gone = last_view_ != nullptr && last_view_->snapshot().revision() < kept_.front().state->revision();
  if (is_gone) last_view.swap(last_view_);
}

bool SnapshotHistory::HoldBlocks(bool even_written) const {
  std::unordered_set<const Submap*> looked_at;  // states share most submaps
  for (const State& state : All()) {            // without blocking readers
    for (const auto& submap : state->submaps()) {
      if (!looked_at.insert(submap.get()).second) continue;
      const auto tiles = submap->blocks().tiles_if_read();
      const bool holds_any = std::any_of(tiles.begin(), tiles.end(), [even_written](const TileEntry& tile) {
        return tile.tile->loader() != nullptr ? tile.tile->loader()->IsRead() : even_written && tile.tile->CanBeLeft();
      });
      const auto& unread = submap->blocks().unread();
      if (holds_any || (unread != nullptr && unread->HoldsBlocks())) return true;
    }
  }
  return false;
}

void SnapshotHistory::EvictPages(State same) {
  std::deque<Kept> dropped;  // freed after the mutex is released
  View last_view;
  const MutexLock lock(mutex_);
  dropped.swap(kept_);
  last_view.swap(last_view_);
  share_.Release();
  const bool is_newest = !dropped.empty() && dropped.back().state->revision() == same->revision();
  if (is_newest) kept_.push_back({std::move(same), 0});
}

std::deque<SnapshotHistory::Kept>::const_iterator SnapshotHistory::FirstFrom(std::int64_t revision) const {
  return std::lower_bound(kept_.begin(), kept_.end(), revision,
                          [](const Kept& kept, std::int64_t wanted) { return kept.state->revision() < wanted; });
}

SnapshotHistory::View SnapshotHistory::Find(std::int64_t revision) const {
  View before;  // destroyed after the mutex is released
  const MutexLock lock(mutex_);
  const auto found = FirstFrom(revision);
  if (found == kept_.end() || found->state->revision() != revision) return nullptr;
  if (last_view_ == nullptr || last_view_->shared_snapshot() != found->state) {
    auto view = std::make_shared<const MapView>(found->state);
    before = std::exchange(last_view_, std::move(view));
  }
  return last_view_;
}

SnapshotHistory::State SnapshotHistory::StateAt(std::int64_t revision) const {
  const MutexLock lock(mutex_);
  const auto found = FirstFrom(revision);
  return found != kept_.end() && found->state->revision() == revision ? found->state : nullptr;
}

std::vector<SnapshotHistory::State> SnapshotHistory::All() const {
  const MutexLock lock(mutex_);
  std::vector<State> all;
  all.reserve(kept_.size());
  for (const Kept& kept : kept_) all.push_back(kept.state);
  return all;
}

SnapshotHistory::Neighbours SnapshotHistory::Around(std::int64_t revision) const {
  const MutexLock lock(mutex_);
  Neighbours nearest;
  const auto next = FirstFrom(revision);
  if (next != kept_.begin()) nearest.before = (next - 1)->state->revision();
  if (next != kept_.end()) nearest.after = next->state->revision();
  return nearest;
}

std::size_t SnapshotHistory::size() const {
  const MutexLock lock(mutex_);
  return kept_.size();
}

std::size_t SnapshotHistory::bytes() const {
  const MutexLock lock(mutex_);
  return share_.bytes();
}

Result<SnapshotHistory::View> ViewAt(std::int64_t revision, const SnapshotHistory::View& present,
                                     const SnapshotHistory& kept, const LostRevisions& lost, const std::string& field) {
  const MapSnapshot& now = present->snapshot();
  if (revision <= 0 || revision > now.revision()) return RevisionNotReached(revision, now, field);
  if (revision == now.revision()) return present;
  DHPMAP_RETURN_IF_ERROR(CheckNotLost(revision, lost, now.info(), field));
  const auto view = kept.Find(revision);
  // A new map of the same name has another history: its revisions do not count.
  if (view != nullptr && view->snapshot().info().history_id == now.info().history_id) return view;
  return RevisionNotKept(revision, now, kept.Around(revision));
}

}  // namespace dhpmap
