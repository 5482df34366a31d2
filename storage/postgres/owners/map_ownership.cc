// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/owners/map_ownership.h"

#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/map/history_id.h"
#include "storage/postgres/owners/lost_answer.h"

namespace dhpmap::postgres {
namespace {

const std::string kOwnerOf = "SELECT owner FROM maps WHERE map_key = $1";

/// Beyond it some are forgotten: a commit to one would take the map, and be refused for its revision.
constexpr std::size_t kMostLeft = 100'000;

}  // namespace

MapOwnership::MapOwnership(Pool& pool, Peers& peers, PassingTime time)
    : pool_(pool), peers_(peers), time_(OrSteadyClock(std::move(time))) {}

std::shared_ptr<OwnedMap> MapOwnership::Find(const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = maps_.find(name);
  return found == maps_.end() ? nullptr : found->second;
}

MapOwnership::Counts MapOwnership::counts() const {
  const MutexLock lock(mutex_);
  return {
      .num_owned = static_cast<std::int64_t>(maps_.size()), .num_taken_over = num_taken_over_, .num_lost = num_lost_};
}

Result<std::shared_ptr<OwnedMap>> MapOwnership::Own(const std::string& name, For what) {
  if (what == For::kWriting) {
    const MutexLock lock(mutex_);
    if (left_.contains(name)) return NotOwner(name);
  }
  DHPMAP_ASSIGN_OR_RETURN(const Claim claim, ClaimMap(name));
  if (claim.ours == nullptr) return NotOwnerBut(claim.server, name);
  const MutexLock lock(mutex_);
  left_.erase(name);
  return claim.ours;
}

std::shared_ptr<OwnedMap> MapOwnership::New(const std::string& name) const {
  constexpr std::int64_t kFirstEpoch = 1, kNothingSeen = 0;
  return std::make_shared<OwnedMap>(name, static_cast<std::int64_t>(DrawHistoryId()), kFirstEpoch, kNothingSeen, time_);
}

void MapOwnership::Add(std::shared_ptr<OwnedMap> map) {
  const MutexLock lock(mutex_);
  const std::string& name = map->name;
  left_.erase(name);
  maps_[name] = std::move(map);
}

bool MapOwnership::Erase(const OwnedMap& map) {
  const auto found = maps_.find(map.name);
  if (found == maps_.end() || found->second.get() != &map) return false;
  maps_.erase(found);
  return true;
}

void MapOwnership::Drop(const OwnedMap& map) {
  const MutexLock lock(mutex_);
  Erase(map);
}

bool MapOwnership::Leave(const OwnedMap& map) {
  const MutexLock lock(mutex_);
  if (!Erase(map)) return false;
  if (left_.size() >= kMostLeft) left_.erase(left_.begin());
  left_.insert(map.name);
  return true;
}

void MapOwnership::Lose(const OwnedMap& map) {
  if (!Leave(map)) return;
  {
    const MutexLock lock(mutex_);
    ++num_lost_;
  }
  const MutexLock lock(told_mutex_);
  const std::function<void(const std::string& map)> tell = on_lost_;
  if (tell) TellSafely([&] { tell(map.name); });
}

Status MapOwnership::LoseAndAsk(const OwnedMap& map) {
  Lose(map);
  const auto owner = pool_.Read<std::int64_t>([&](Connection& connection) -> Result<std::int64_t> {
    Call call{&kOwnerOf};
    call.values.Add(map.key);
    DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, "ask who has a map"));
    return answer.Next() ? answer.Int() : 0;
  });
  return NotOwnerBut(owner.ok() ? *owner : 0, map.name);
}

Status MapOwnership::NotOwnerBut(std::int64_t owner, const std::string& map) const {
  const auto row = owner == server() ? std::nullopt : peers_.Find(owner);
  if (!row || row->address.empty()) return NotOwner(map);
  return NotOwner(map).WithMetadata("owner", row->address);
}

void MapOwnership::OnLost(std::function<void(const std::string& map)> on_lost) {
  const MutexLock lock(told_mutex_);
  on_lost_ = std::move(on_lost);
}

void MapOwnership::StopTaking() {
  const MutexLock lock(mutex_);
  takes_ = false;
}

std::vector<std::shared_ptr<OwnedMap>> MapOwnership::BeginLookThrough() {
  const MutexLock lock(mutex_);
  ++round_;
  std::vector<std::shared_ptr<OwnedMap>> maps;
  maps.reserve(maps_.size());
  for (const auto& [name, map] : maps_) maps.push_back(map);
  return maps;
}

std::int64_t MapOwnership::Round() {
  const MutexLock lock(mutex_);
  return round_;
}

void MapOwnership::OnBeaten() {
  const MutexLock lock(mutex_);
  ++num_beats_;
  is_beaten_.NotifyAll();
}

}  // namespace dhpmap::postgres
