// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/map_ownership.h"

#include <utility>

#include "mapping/map/history_id.h"
#include "storage/postgres/catalog.h"

namespace dhpmap::postgres {

MapOwnership::MapOwnership(Pool& pool, PassingTime time)
    : pool_(pool), time_(OrSteadyClock(std::move(time))), server_(static_cast<std::int64_t>(DrawHistoryId())) {}

std::shared_ptr<OwnedMap> MapOwnership::Find(const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = maps_.find(name);
  return found == maps_.end() ? nullptr : found->second;
}

Result<std::shared_ptr<OwnedMap>> MapOwnership::Own(const std::string& name) {
  if (auto known = Find(name)) return known;
  // Of two that take it at once the first wins, and the other finds it.
  auto taken = pool_.Read<std::shared_ptr<OwnedMap>>(
      [&](Connection& connection) { return TakeMap(connection, name, server_, time_); });
  const MutexLock lock(mutex_);
  const auto found = maps_.find(name);
  if (found != maps_.end() && (!taken.ok() || found->second->epoch > (*taken)->epoch)) return found->second;
  if (taken.ok()) maps_[name] = *taken;
  return taken;
}

std::shared_ptr<OwnedMap> MapOwnership::New(const std::string& name) const {
  constexpr std::int64_t kFirstEpoch = 1, kNothingSeen = 0;
  return std::make_shared<OwnedMap>(name, static_cast<std::int64_t>(DrawHistoryId()), kFirstEpoch, kNothingSeen, time_);
}

void MapOwnership::Add(std::shared_ptr<OwnedMap> map) {
  const MutexLock lock(mutex_);
  const std::string& name = map->name;
  maps_[name] = std::move(map);
}

void MapOwnership::Drop(const OwnedMap& map) {
  const MutexLock lock(mutex_);
  const auto found = maps_.find(map.name);
  if (found != maps_.end() && found->second.get() == &map) maps_.erase(found);
}

}  // namespace dhpmap::postgres
