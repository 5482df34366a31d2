// SPDX-License-Identifier: BSD-3-Clause
// Maps are opened on the first access, and closed when they are idle.
#include <chrono>
#include <utility>

#include "mapping/base/guarded.h"
#include "server/app/maps/map_registry.h"
#include "server/app/maps/no_such_map.h"
#include "server/app/maps/not_owner.h"
#include "server/app/open_map/shutting_down.h"

namespace dhpmap {

Result<std::shared_ptr<OpenMap>> MapRegistry::GetOpen(const std::string& name) {
  {
    const MutexLock lock(mutex_);
    if (const auto found = entries_.find(name); found != entries_.end()) {
      Entry& entry = *found->second;
      entry.last_used = Clock::now();
      if (entry.open_map && !entry.is_lost) return entry.open_map;
      if (entry.is_repaired) {
        return ResourceExhausted("the map is being repaired: try again later").WithReason("TOO_BUSY");
      }
    }
  }
  const Place place(*this, name);
  const MutexLock busy(place->busy);
  bool is_lost = false;
  {
    const MutexLock lock(mutex_);
    place->last_used = Clock::now();
    if (place->open_map && !place->is_lost) return place->open_map;
    is_lost = place->is_lost;
  }
  if (is_lost) MoveAway(name, *place, NotOwner(name, ""));
  auto open_map = Load(name, *place);
  if (!open_map.ok()) return WithSuggestion(open_map.status(), name);
  return open_map;
}

Result<std::shared_ptr<OpenMap>> MapRegistry::Load(const std::string& name, Entry& entry) {
  {
    const MutexLock lock(mutex_);
    entry.is_lost = false;  // before loading: from then on the map may be lost again
  }
  DHPMAP_ASSIGN_OR_RETURN(std::shared_ptr<const MapSnapshot> snapshot, store_.LoadMap(name));
  // After loading: taking a map from another process may leave lost numbers behind.
  DHPMAP_ASSIGN_OR_RETURN(MapInStore stored, AskStore(name));
  auto open_map = Install(entry, std::move(snapshot), std::move(stored.lost_revisions));
  if (open_map == nullptr) return ShuttingDown();
  if (followed_ != nullptr) followed_->Drop(name);
  if (options_.on_loaded) options_.on_loaded(open_map->View()->snapshot().info());
  return open_map;
}

bool MapRegistry::MustLoad(const std::string& name) const {
  return !name.empty() && ValidateMapName(name).ok() && FindOpen(name) == nullptr;
}

Result<std::shared_ptr<const MapView>> MapRegistry::ViewOf(const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const auto open_map, GetOpen(name));
  KeepPagesInBounds();
  return open_map->View();
}

void MapRegistry::KeepPagesInBounds() {
  const PageOptions& pages = map_options_.pages;
  if (pages.budget_bytes == 0 || ResidentBytes(pages) <= BytesToKeep(pages)) return;
  for (const auto& open_map : OpenMaps()) open_map->KeepPagesInBounds();
}

Result<std::shared_ptr<const MapView>> MapRegistry::ViewAt(const std::string& name, std::int64_t revision,
                                                           const std::string& field) {
  DHPMAP_ASSIGN_OR_RETURN(const auto open_map, GetOpen(name));
  KeepPagesInBounds();
  return dhpmap::ViewAt(revision, open_map->View(), *open_map->history(), *LostRevisionsOf(name), field);
}

std::optional<FinishProgress> MapRegistry::FinishingOf(const std::string& name) const {
  const auto open_map = FindOpen(name);
  return open_map != nullptr ? open_map->Finishing() : std::nullopt;
}

std::shared_ptr<const MapSnapshot> MapRegistry::PresentOf(const MapSnapshot& state) const {
  const std::string& name = state.info().name;
  const auto open_map = FindOpen(name);
  const auto view = open_map != nullptr ? open_map->View() : followed_ != nullptr ? followed_->Find(name) : nullptr;
  if (view == nullptr) return nullptr;
  auto present = view->shared_snapshot();
  if (present->info().history_id != state.info().history_id) return nullptr;
  auto kept = open_map != nullptr ? open_map->history()->StateAt(state.revision()) : nullptr;
  return kept != nullptr ? kept : present;
}

std::vector<std::shared_ptr<OpenMap>> MapRegistry::OpenMaps() const {
  const MutexLock lock(mutex_);
  std::vector<std::shared_ptr<OpenMap>> open_maps;
  for (const auto& [name, entry] : entries_) {
    if (entry->open_map) open_maps.push_back(entry->open_map);
  }
  return open_maps;
}

void MapRegistry::GiveUpMapping() {
  for (const auto& open_map : OpenMaps()) open_map->GiveUpMapping();
}

Status MapRegistry::Shutdown() {
  {
    const MutexLock lock(mutex_);
    is_shut_down_ = true;
  }
  if (Fleet* const fleet = store_.fleet()) fleet->OnLost({});
  closer_wake_.NotifyAll();
  closer_.Join();
  keeper_.Stop();
  if (followed_ != nullptr) followed_->Stop();
  Status outcome;
  for (const auto& open_map : OpenMaps()) {
    if (const Status stored = open_map->Stop(); !stored.ok() && open_map->loss().ok()) outcome = stored;
  }
  return outcome;
}

void MapRegistry::CloserLoop() {
  constexpr double kNever_s = 1e6;
  const bool closes_idle = options_.idle_close_s > 0;
  const auto period = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(closes_idle ? options_.idle_close_s / 4 : kNever_s));
  const auto is_woken = [this]() DHPMAP_REQUIRES(mutex_) { return is_shut_down_ || !lost_names_.empty(); };
  auto next = Clock::now() + period;
  MutexLock lock(mutex_);
  while (!is_shut_down_) {
    (void)closer_wake_.WaitUntil(mutex_, next, is_woken);
    if (is_shut_down_) return;
    lock.Unlock();
    TellSafely([this] { CloseLostMaps(); });
    if (Clock::now() >= next) {
      if (closes_idle) TellSafely([this] { CloseIdleMaps(Clock::now()); });  // tried again if memory runs out
      TellSafely([this] { KeepPagesInBounds(); });
      next = Clock::now() + period;
    }
    lock.Lock();
  }
}

void MapRegistry::CloseIdleMaps(Clock::time_point now) {
  std::vector<std::string> open;
  {
    const MutexLock lock(mutex_);
    for (const auto& [name, entry] : entries_) {
      if (entry->open_map) open.push_back(name);
    }
  }
  for (const std::string& name : open) {
    const Place place(*this, name);
    CloseIfIdle(*place, now);
  }
}

void MapRegistry::CloseIfIdle(Entry& entry, Clock::time_point now) {
  const auto limit = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.idle_close_s));
  CloseIfAtRest(entry, now - limit, Closing::kIfNotViewed);
}

void MapRegistry::CloseIfAtRest(Entry& entry, Clock::time_point used_until, Closing closing) {
  const MutexLock busy(entry.busy);  // callers that need the map wait, and load it again
  std::shared_ptr<OpenMap> open_map;
  {
    const MutexLock lock(mutex_);
    const bool is_held = entry.open_map.use_count() != 1;  // new users need the registry's lock
    if (is_shut_down_ || !entry.open_map || is_held || entry.last_used > used_until) return;
    if (!entry.open_map->IsAtRest()) return;
    // A viewed state would lose its unread parts with the next change, unless this open map makes the change.
    if (closing == Closing::kIfNotViewed && map_options_.pages.budget_bytes > 0 && entry.open_map->IsViewed()) return;
    MapSummary last = SummaryOf(entry.open_map->View()->snapshot());
    const std::string name = last.info.name;
    summaries_.Forget(name);
    summaries_.Add(name, {std::move(last), entry.lost_revisions}, summaries_.number());
    open_map = std::exchange(entry.open_map, nullptr);
  }
  (void)open_map->Stop();  // nothing is left to store
  const std::string name = open_map->View()->snapshot().info().name;
  open_map.reset();
  surfaces_.Forget(name);
  if (Fleet* const fleet = store_.fleet()) (void)fleet->GiveUp(name, 0);  // on an error it stays ours, closed
}

std::shared_ptr<OpenMap> MapRegistry::Install(Entry& entry, std::shared_ptr<const MapSnapshot> snapshot,
                                              std::shared_ptr<const LostRevisions> lost_revisions) {
  OpenMapOptions options = map_options_;
  options.publish.prepare = [this](const VisibleSnapshot::State& state, std::function<void()> ready) {
    return keeper_.Note(state, std::move(ready));
  };
  const std::string name = snapshot->info().name;
  options.commit.on_stored = [this, name] { changes_.Notify(name); };
  options.on_finishing = options.commit.on_stored;
  options.commit.on_commit = [this, name, tell = std::move(options.commit.on_commit)](double seconds,
                                                                                      const Status& outcome) {
    if (tell) tell(seconds, outcome);
    // The store holds another state than the one served here, see CommitWorker::loss: load the map again.
    if (outcome.reason() == Reason("STALE_REVISION")) NoteLoss(name);
  };
  auto open_map = std::make_shared<OpenMap>(std::move(snapshot), store_, std::move(options));
  const MutexLock lock(mutex_);
  if (is_shut_down_) return nullptr;
  entry.open_map = open_map;
  entry.lost_revisions = std::move(lost_revisions);
  summaries_.Forget(name);
  return open_map;
}

}  // namespace dhpmap
