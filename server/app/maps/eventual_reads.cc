// SPDX-License-Identifier: BSD-3-Clause
// Reads of maps that other processes write.
#include <memory>
#include <utility>

#include "server/app/maps/map_registry.h"

namespace dhpmap {
namespace {

FollowOptions FollowOptionsOf(const RegistryOptions& options, const PageOptions& pages) {
  FollowOptions follow{.idle_drop_s = std::chrono::duration<double>(options.idle_close_s)};
  if (pages.budget_bytes > 0) follow.max_bytes = pages.budget_bytes;
  return follow;
}

}  // namespace

void MapRegistry::FollowOthers(Fleet& fleet) {
  FollowOptions follow = FollowOptionsOf(options_, map_options_.pages);
  follow.watched = [this] { return changes_.WatchedMaps(); };
  follow.on_commit = [this](const std::string& map) { changes_.Notify(map); };
  follow.on_state = [this](const std::shared_ptr<const MapSnapshot>& state) { (void)keeper_.Note(state); };
  followed_ = std::make_unique<FollowedMaps>(store_, fleet, std::move(follow));
  changes_.OnWatched([this] { followed_->NoteWatched(); });
}

std::shared_ptr<OpenMap> MapRegistry::UseIfOpen(const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end() || found->second->open_map == nullptr || found->second->is_lost) return nullptr;
  found->second->last_used = Clock::now();
  return found->second->open_map;
}

Result<std::shared_ptr<const MapView>> MapRegistry::EventualViewOf(const std::string& name, std::int64_t at_least) {
  if (followed_ == nullptr) return ViewOf(name);
  const auto open_map = UseIfOpen(name);
  if (open_map == nullptr) return followed_->ViewOf(name, at_least);
  KeepPagesInBounds();
  return open_map->View();
}

bool MapRegistry::MustLoadForEventual(const std::string& name) const {
  if (followed_ == nullptr) return MustLoad(name);
  return MustLoad(name) && followed_->Find(name) == nullptr;
}

Result<MapSummary> MapRegistry::GetEventual(const std::string& name) const {
  const bool is_copied = followed_ != nullptr && FindOpen(name) == nullptr;
  const auto view = is_copied ? followed_->Find(name) : nullptr;
  if (view == nullptr) return Get(name);
  return SummaryOf(view->snapshot());
}

}  // namespace dhpmap
